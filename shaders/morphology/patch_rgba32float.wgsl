// Changed pixels, as the output stores them.
@group(0) @binding(1) var patches: texture_storage_2d<rgba32float, write>;
