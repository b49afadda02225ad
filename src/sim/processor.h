#pragma once

namespace offstage {

/// Whether this processor can work on 32 bytes at a time (AVX2). Whatever asks gives the same bits either
/// way.
inline bool processorIsWide() {
#ifdef __x86_64__
  static const bool kWide = __builtin_cpu_supports("avx2") != 0;
  return kWide;
#else
  return false;
#endif
}

} // namespace offstage
