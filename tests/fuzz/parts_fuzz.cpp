#include "render/job/manifest.h"
#include "render/output/chunk_file.h"
#include "src/sim/error.h"
#include "tests/fuzz/memory_file.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

/// Whatever lies in OUT.parts/ is a chunk of a video or a manifest, or is refused; a manifest is the same
/// after it was written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const offstage::fuzz::MemoryFile file(data, size);
  try {
    offstage::ChunkFileReader reader(file.path());
    std::vector<std::uint8_t> record;
    while (reader.next(record))
      if (record.size() > size) __builtin_trap();
  } catch (const offstage::Error&) {
    if (offstage::isWholeChunk(file.path())) __builtin_trap();
  }
  const auto manifest = offstage::Manifest::parse({reinterpret_cast<const char*>(data), size});
  if (manifest && offstage::Manifest::parse(manifest->text()) != manifest) __builtin_trap();
  return 0;
}
