// PassContext::dispatch: groups of 64 in two dimensions, since one takes 65,535 groups at most. The
// last invocations are beyond the count.
layout(local_size_x = 64) in;

uint invocation_index() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
}
