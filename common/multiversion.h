#pragma once

/// Put before a hot loop's function: compiled for the baseline and for wider vector units, chosen
/// when the program loads. Results are equal on every machine (no fused multiply-add is allowed;
/// see cmake/targets.cmake). Sanitizers cannot run code that early, and clang 14 cannot make it.
#if defined(__GNUC__) && !defined(__clang__) && !defined(ROOMWISE_SANITIZED) && defined(__x86_64__)
#define ROOMWISE_MULTIVERSION \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ROOMWISE_MULTIVERSION
#endif
