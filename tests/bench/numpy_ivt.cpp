#include "tests/bench/numpy_ivt.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "tests/support/temporary_folder.h"

namespace gazeloop::bench {
namespace {

/// What a command of the shell writes; none where it fails.
std::optional<std::string> output_of(const std::string& command) {
    std::string text;
    FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        return std::nullopt;
    }
    std::array<char, 256> part{};
    while (std::fgets(part.data(), part.size(), pipe) != nullptr) {
        text += part.data();
    }
    return pclose(pipe) == 0 ? std::optional(text) : std::nullopt;
}

}  // namespace

std::optional<NumpyIvt> numpy_ivt(std::span<const glm::dvec3> directions, double seconds) {
    if (!output_of("python3 -c 'import numpy' 2> /dev/null")) {
        fmt::print(stderr, "prediction: I-VT in numpy is skipped: python3 has no numpy here\n");
        return std::nullopt;
    }
    const tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "directions").string();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(directions.data()),
               static_cast<std::streamsize>(directions.size_bytes()));
    const auto output =
        output_of(fmt::format("OMP_NUM_THREADS=1 python3 '{}/tests/bench/ivt.py' '{}' {}",
                              GAZELOOP_SOURCE_DIR, file, seconds));
    const nlohmann::json found = output ? nlohmann::json::parse(*output) : nlohmann::json();
    if (!output || found.at("whole_saccades") == 0 || found.at("online_saccades") == 0) {
        throw std::runtime_error("I-VT in numpy failed, or found no saccade");
    }
    return NumpyIvt{.whole_ns = found.at("whole_ns"), .online_ns = found.at("online_ns")};
}

}  // namespace gazeloop::bench
