#pragma once

/// Before a function: it is compiled for processors with AVX2 too, and the right one is chosen when the
/// program starts. Only the width of the vectors differs, so both give the same bits (no contraction, no
/// reassociation). Left out under sanitizers, which are not ready when the choice is made.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(OFFSTAGE_NO_CLONES)
#define OFFSTAGE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define OFFSTAGE_VECTOR_CLONES
#endif
