// A shape that deposits nothing has nothing in the maps to take out, and of strands along which T is
// known it has been. Include it first.
#if defined(OWN_CORRECTION) && (!defined(DEPOSITS) || defined(STRANDS) && defined(ALONG_STRANDS))
#undef OWN_CORRECTION
#endif
