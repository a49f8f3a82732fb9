// No shadow at all: the baseline of every timing.
#include "lib/receiver.glsl"

float shadow_transmittance(Receiver receiver) { return 1.0; }
