// A shape that deposits nothing has nothing in the maps to take out. Include it first.
#if defined(OWN_CORRECTION) && !defined(DEPOSITS)
#undef OWN_CORRECTION
#endif
