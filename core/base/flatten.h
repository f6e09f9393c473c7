#pragma once

/// Before a function: it becomes one with all that it calls, for loops over bodies in which a call
/// costs more than what it does. Under sanitizers it does not, as with their checks such a function
/// takes minutes to compile.
#ifdef SLIPCHECK_SANITIZE
#define SLIPCHECK_FLATTEN
#else
#define SLIPCHECK_FLATTEN [[gnu::flatten]]
#endif
