// Why a pixel gets more samples, in bits.

// The probes disagree, here or beside.
const PROBES: u32 = 1u;
// An edge of the geometry passes, whatever the probes hit.
const OUTLINE: u32 = 2u;
