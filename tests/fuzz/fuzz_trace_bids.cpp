#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "drivers/trace/bids/read_bids.h"
#include "tests/fuzz/fuzz_trace.h"
#include "tests/support/temporary_folder.h"

namespace {

void write(const std::filesystem::path& file, const std::uint8_t* data, std::size_t size) {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

}  // namespace

/// A sidecar, a zero byte, and the table that it describes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using gazeloop::fuzz::require;
    static const gazeloop::tests::TemporaryFolder folder;
    const std::uint8_t* const end = data + size;
    const std::uint8_t* const zero = std::find(data, end, std::uint8_t{0});
    const std::uint8_t* const rows = zero == end ? end : zero + 1;
    write(folder / "sub-1_physio.json", data, static_cast<std::size_t>(zero - data));
    write(folder / "sub-1_physio.tsv", rows, static_cast<std::size_t>(end - rows));
    const auto trace = gazeloop::drivers::read_bids(folder / "sub-1_physio.tsv", {});
    if (!trace) {
        require(trace.error().kind == gazeloop::ErrorKind::BadInput &&
                !trace.error().message.empty());
        return 0;
    }
    require(!trace->samples.empty());
    for (const gazeloop::gaze::GazeSample& sample : trace->samples) {
        for (const gazeloop::gaze::EyeRay& ray : sample.eyes) {
            require(!ray.valid || std::abs(glm::length(ray.direction) - 1.0) < 1e-8);
        }
    }
    return 0;
}
