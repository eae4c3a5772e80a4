// LIGHTSWEEP_CLONES before a function: it is compiled for several instruction sets, and the widest that the processor
// has is taken when the program is loaded. Every one gives the same bits, since nothing is contracted or reordered.
#pragma once

#include <cstddef>  // brings in the C library's own macros

#if defined(__SANITIZE_ADDRESS__)
#define LIGHTSWEEP_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LIGHTSWEEP_SANITIZED 1
#endif
#endif

// The choice is an indirect function of glibc; it is made before the sanitizers' runtime is up.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(LIGHTSWEEP_SANITIZED)
#define LIGHTSWEEP_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LIGHTSWEEP_CLONES
#endif
