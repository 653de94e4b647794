#pragma once

#include <zlib.h>

#include <stdexcept>
#include <string>

namespace gazeloop::tests {

/// One gzip member.
inline std::string gzipped(std::string text) {
    constexpr int kLargestWindow = 15;
    constexpr int kGzip = 16;
    constexpr int kMemory = 8;
    z_stream state{};
    if (deflateInit2(&state, Z_BEST_SPEED, Z_DEFLATED, kLargestWindow + kGzip, kMemory,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::runtime_error("deflateInit2");
    }
    std::string out(deflateBound(&state, text.size()), '\0');
    state.next_in = reinterpret_cast<Bytef*>(text.data());
    state.avail_in = static_cast<uInt>(text.size());
    state.next_out = reinterpret_cast<Bytef*>(out.data());
    state.avail_out = static_cast<uInt>(out.size());
    const int result = deflate(&state, Z_FINISH);
    out.resize(state.total_out);
    deflateEnd(&state);
    if (result != Z_STREAM_END) {
        throw std::runtime_error("deflate");
    }
    return out;
}

}  // namespace gazeloop::tests
