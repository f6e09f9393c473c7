#pragma once

/// Before a function: it becomes one with all that it calls, for loops over bodies in which a call
/// costs more than what it does. Under sanitizers it does not, as with their checks such a function
/// takes minutes to compile.
#ifdef SLIPCHECK_SANITIZE
#define SLIPCHECK_FLATTEN
#else
#define SLIPCHECK_FLATTEN [[gnu::flatten]]
#endif

/// The same, compiled for processors with AVX too and chosen when the program starts: with three
/// operands an instruction needs fewer copies. The results are the same bits.
#if defined(__gnu_linux__) && defined(__x86_64__) && !defined(__clang__) && \
    !defined(SLIPCHECK_SANITIZE)
#define SLIPCHECK_FLATTEN_WIDE [[gnu::flatten, gnu::target_clones("avx", "default")]]
#else
#define SLIPCHECK_FLATTEN_WIDE SLIPCHECK_FLATTEN
#endif
