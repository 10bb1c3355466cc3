#pragma once

/// Put before a hot loop's function: compiled for the baseline and for wider vector units, chosen
/// when the program loads. Results are equal on every machine (no fused multiply-add is allowed;
/// see cmake/targets.cmake). Sanitizers cannot run code that early, and clang 14 cannot make it.
/// ROOMWISE_MULTIVERSION_256 leaves AVX-512 out, for what keeps masks in vectors: g++ 12 moves them
/// to mask registers and back, which costs more than wider instructions save.
#if defined(__GNUC__) && !defined(__clang__) && !defined(ROOMWISE_SANITIZED) && defined(__x86_64__)
#define ROOMWISE_MULTIVERSION \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define ROOMWISE_MULTIVERSION_256 __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define ROOMWISE_MULTIVERSION
#define ROOMWISE_MULTIVERSION_256
#endif

/// Put before what such a function calls in its loop: inlined, it is compiled for each version too.
#define ROOMWISE_IN_EACH_VERSION [[gnu::always_inline]] inline
