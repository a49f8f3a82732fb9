// Depth of the casters, for whichever depth test the pass sets: the first one, or with the test
// reversed the last one.
#include "lib/deposit.glsl"

void main() { gl_FragDepth = deposit_or_discard().depth; }
