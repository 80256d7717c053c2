//! A headless Chromium and the little of its DevTools protocol that the tests need.

use std::collections::VecDeque;
use std::fs::OpenOptions;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket};

/// How long anything may take that should take a moment.
const PATIENCE: Duration = Duration::from_secs(60);

/// A page in a browser of its own, which ends with it.
pub(super) struct Page {
    process: Child,
    _profile: TempDir,
    socket: WebSocket<TcpStream>,
    calls: u64,
    /// What scripts threw and the console reported.
    pub(super) complaints: VecDeque<String>,
}

/// Starts a browser; none if this machine has none, which then stands in the list that `make test` prints.
pub(super) fn start() -> Option<Page> {
    let page = find().map(|program| Page::start(&program));
    if page.is_none() {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("not-applicable.txt");
        let mut list = OpenOptions::new().create(true).append(true).open(path).expect("the list can be written");
        writeln!(list, "not run: the reports' pages in Chromium (none found; apt-get install chromium)").expect("written");
    }
    page
}

fn find() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("DEJAG_CHROMIUM") {
        return Some(named.into());
    }
    let folders: Vec<PathBuf> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    let names = ["chromium", "chromium-browser", "google-chrome"];
    names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name))).find(|path| path.is_file())
}

impl Page {
    fn start(program: &Path) -> Self {
        let profile = tempfile::tempdir().expect("a folder");
        let process = Command::new(program)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--remote-debugging-port=0"])
            .args(["--window-size=1280,900", "--force-device-scale-factor=1", "--hide-scrollbars"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("{} does not start: {error}", program.display()));
        let port = patiently("a port", || read_port(profile.path()));
        let address = patiently("a page", || page_address(port));
        let stream = TcpStream::connect(("127.0.0.1", port)).expect("it listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("set");
        let (socket, _) = tungstenite::client(address.as_str(), stream).expect("it speaks WebSocket");
        let mut page = Self { process, _profile: profile, socket, calls: 0, complaints: VecDeque::new() };
        for domain in ["Page", "Runtime", "Log"] {
            page.call(&format!("{domain}.enable"), &json!({}));
        }
        page
    }

    /// One call of the protocol and its answer. What is reported meanwhile is kept.
    pub(super) fn call(&mut self, method: &str, parameters: &Value) -> Value {
        self.calls += 1;
        let request = json!({ "id": self.calls, "method": method, "params": parameters });
        self.socket.send(Message::text(request.to_string())).expect("sent");
        loop {
            let message = self.socket.read().unwrap_or_else(|error| panic!("no answer to {method}: {error}"));
            let Message::Text(text) = message else { continue };
            let mut answer: Value = serde_json::from_str(&text).expect("JSON");
            if answer["id"] == self.calls {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].take();
            }
            self.note(&answer);
        }
    }

    fn note(&mut self, event: &Value) {
        let about = &event["params"];
        let complaint = match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => matches!(about["type"].as_str(), Some("error" | "warning" | "assert")),
            Some("Log.entryAdded") => matches!(about["entry"]["level"].as_str(), Some("error" | "warning")),
            _ => false,
        };
        if complaint {
            self.complaints.push_back(about.to_string());
        }
    }

    /// Opens a page from disk, with a fragment, and waits until it is loaded.
    pub(super) fn open(&mut self, file: &Path, fragment: &str) {
        let answer = self.call("Page.navigate", &json!({ "url": format!("file://{}{fragment}", file.display()) }));
        assert!(answer["errorText"].is_null(), "{answer}");
        self.wait("location.protocol === 'file:' && document.readyState === 'complete'");
    }

    /// What an expression comes to, promises awaited.
    #[track_caller]
    pub(super) fn ask(&mut self, expression: &str) -> Value {
        let parameters = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let mut answer = self.call("Runtime.evaluate", &parameters);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].take()
    }

    /// What an expression comes to, as text.
    #[track_caller]
    pub(super) fn text(&mut self, expression: &str) -> String {
        self.ask(expression).as_str().unwrap_or_else(|| panic!("{expression} is no text")).to_owned()
    }

    /// Until an expression is true.
    #[track_caller]
    pub(super) fn wait(&mut self, expression: &str) {
        patiently(expression, || (self.ask(expression) == true).then_some(()));
    }

    /// Presses and releases a key, by the name that `KeyboardEvent.key` has for it.
    pub(super) fn key(&mut self, key: &str) {
        self.key_with(key, 0);
    }

    /// With modifiers: 8 is Shift.
    pub(super) fn key_with(&mut self, key: &str, modifiers: u32) {
        let code = match key {
            "Enter" => 13,
            "Escape" => 27,
            " " => 32,
            "ArrowLeft" => 37,
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            _ => 0,
        };
        let text = match key {
            "Enter" => "\r",
            _ if key.chars().count() == 1 => key,
            _ => "",
        };
        for kind in ["keyDown", "keyUp"] {
            let text = if kind == "keyDown" { text } else { "" };
            let parameters =
                json!({ "type": kind, "key": key, "text": text, "windowsVirtualKeyCode": code, "modifiers": modifiers });
            self.call("Input.dispatchKeyEvent", &parameters);
        }
    }

    /// Keys for each character.
    pub(super) fn type_text(&mut self, text: &str) {
        text.chars().for_each(|character| self.key(&character.to_string()));
    }

    /// A pointer's event at a place of the viewport, in CSS pixels.
    pub(super) fn mouse(&mut self, kind: &str, [x, y]: [f64; 2]) {
        let button = if kind == "mouseMoved" { "none" } else { "left" };
        self.call("Input.dispatchMouseEvent", &json!({ "type": kind, "x": x, "y": y, "button": button, "clickCount": 1 }));
    }

    /// A click into the middle of what a selector finds.
    pub(super) fn click(&mut self, selector: &str) {
        let at = self.ask(&format!(
            "(() => {{ const e = document.querySelector({selector:?}); e.scrollIntoView({{ block: 'center', behavior: 'instant' }}); \
             const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()"
        ));
        let at = [at[0].as_f64().expect("x"), at[1].as_f64().expect("y")];
        ["mouseMoved", "mousePressed", "mouseReleased"].iter().for_each(|kind| self.mouse(kind, at));
    }

    /// A colour scheme, a medium, less motion: the page is told that its user wants it so.
    pub(super) fn prefer(&mut self, media: &str, features: &[(&str, &str)]) {
        let features: Vec<Value> = features.iter().map(|(name, value)| json!({ "name": name, "value": value })).collect();
        self.call("Emulation.setEmulatedMedia", &json!({ "media": media, "features": features }));
    }

    /// Width and height of the viewport in CSS pixels.
    pub(super) fn resize(&mut self, [width, height]: [u32; 2]) {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", &metrics);
    }

    /// Keeps what is seen, for people, where `DEJAG_SCREENSHOTS` names a folder.
    pub(super) fn shoot(&mut self, name: &str) {
        self.keep(name, "png", "Page.captureScreenshot", &json!({}));
    }

    /// The same of what would be printed.
    pub(super) fn print(&mut self, name: &str) {
        self.keep(name, "pdf", "Page.printToPDF", &json!({ "printBackground": true }));
    }

    fn keep(&mut self, name: &str, extension: &str, method: &str, parameters: &Value) {
        let Some(folder) = std::env::var_os("DEJAG_SCREENSHOTS") else { return };
        let answer = self.call(method, parameters);
        let bytes = STANDARD.decode(answer["data"].as_str().expect("data")).expect("base64");
        std::fs::write(Path::new(&folder).join(name).with_extension(extension), bytes).expect("written");
    }

    /// Fails if anything was thrown or reported.
    #[track_caller]
    pub(super) fn must_be_content(&mut self) {
        // Whatever was reported before this answer has been read with it.
        self.ask("new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(true), 50)))");
        assert!(self.complaints.is_empty(), "{:#?}", self.complaints);
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Asks again until there is an answer.
#[track_caller]
fn patiently<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(start.elapsed() < PATIENCE, "no {what}");
        sleep(Duration::from_millis(20));
    }
}

/// The browser writes down which port it took.
fn read_port(profile: &Path) -> Option<u16> {
    std::fs::read_to_string(profile.join("DevToolsActivePort")).ok()?.lines().next()?.parse().ok()
}

/// The WebSocket of the first page.
fn page_address(port: u16) -> Option<String> {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).ok()?;
    stream.set_read_timeout(Some(PATIENCE)).ok()?;
    write!(stream, "GET /json/list HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n").ok()?;
    let mut answer = BufReader::new(stream);
    let mut length = 0;
    for line in answer.by_ref().lines() {
        let line = line.ok()?.to_ascii_lowercase();
        if let Some(given) = line.strip_prefix("content-length:") {
            length = given.trim().parse().ok()?;
        }
        if line.is_empty() {
            break;
        }
    }
    let mut body = vec![0; length];
    answer.read_exact(&mut body).ok()?;
    let targets: Value = serde_json::from_slice(&body).ok()?;
    let page = targets.as_array()?.iter().find(|target| target["type"] == "page")?;
    page["webSocketDebuggerUrl"].as_str().map(str::to_owned)
}
