#include "render/output/stream_hash.h"

#define XXH_STATIC_LINKING_ONLY // the size of the streaming state
#include <xxhash.h>

namespace offstage {

struct StreamHash::State {
  XXH3_state_t xxh;
};

StreamHash::StreamHash() : state_(std::make_unique<State>()) {
  XXH3_INITSTATE(&state_->xxh);
  XXH3_64bits_reset(&state_->xxh);
}

StreamHash::~StreamHash() = default;

void StreamHash::add(const void* data, std::size_t size) {
  XXH3_64bits_update(&state_->xxh, data, size);
}

std::uint64_t StreamHash::value() const {
  return XXH3_64bits_digest(&state_->xxh);
}

} // namespace offstage
