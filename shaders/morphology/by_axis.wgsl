// Weights of every pixel on the lists: of its line along the row, and of that along the column.

@compute @workgroup_size(64)
fn cs_rows(@builtin(global_invocation_id) thread: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let axis = along_rows(vec2<i32>(textureDimensions(weights)));
    for (var i = thread.x; i < tally[ROWS + 3u]; i += 64u * groups.x) {
        let pixel = listed(pixels[i]);
        textureStore(weights, pixel, vec4<u32>(packed(line_weights(axis, pixel.x, pixel.y))));
    }
}

@compute @workgroup_size(64)
fn cs_columns(@builtin(global_invocation_id) thread: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let axis = along_columns(vec2<i32>(textureDimensions(weights)));
    for (var i = thread.x; i < tally[COLUMNS + 3u]; i += 64u * groups.x) {
        let pixel = listed(pixels[i]);
        textureStore(weights, pixel, vec4<u32>(packed(line_weights(axis, pixel.y, pixel.x))));
    }
}
