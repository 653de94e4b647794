#include "runtime/cli/output_file.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace gazeloop::cli {

Expected<void> write_text(const std::filesystem::path& file, std::string_view text) {
    const auto refuse = [&] {
        return std::unexpected(
            Error{ExitCode::BadInput,
                  fmt::format("{}: cannot be written ({})", file.string(), std::strerror(errno))});
    };
    if (file == "-") {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
            return refuse();
        }
        return {};
    }
    const auto close = [](std::FILE* out) { std::fclose(out); };
    std::unique_ptr<std::FILE, decltype(close)> out(std::fopen(file.c_str(), "w"), close);
    if (out == nullptr || std::fwrite(text.data(), 1, text.size(), out.get()) != text.size() ||
        std::fflush(out.get()) != 0) {
        return refuse();
    }
    return {};
}

}  // namespace gazeloop::cli
