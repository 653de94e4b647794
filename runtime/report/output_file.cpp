#include "runtime/report/output_file.h"

#include <fmt/core.h>

#include <system_error>

namespace gazeloop::report {

namespace fs = std::filesystem;

Expected<void> check_apart(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs) {
    const auto same = [](const fs::path& a, const fs::path& b) {
        std::error_code missing;
        return a == b || files::followed(a) == files::followed(b) || fs::equivalent(a, b, missing);
    };
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto& [name, file] = outputs[i];
        if (file.empty()) {
            continue;
        }
        for (const NamedFile& before : outputs.first(i)) {
            if (!before.file.empty() && same(before.file, file)) {
                return std::unexpected(
                    Error{ErrorKind::Usage,
                          fmt::format("{} and {} both name {}: give each a file of its own",
                                      before.name, name, file.string())});
            }
        }
        for (const NamedFile& read : inputs) {
            if (file != "-" && !read.file.empty() && same(read.file, file)) {
                return std::unexpected(
                    Error{ErrorKind::Usage,
                          fmt::format("{} names {}, which is read ({}): it would be lost; name "
                                      "another file",
                                      name, file.string(), read.name)});
            }
        }
    }
    return {};
}

}  // namespace gazeloop::report
