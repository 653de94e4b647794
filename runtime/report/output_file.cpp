#include "runtime/report/output_file.h"

#include <fmt/core.h>

#include <string>
#include <system_error>
#include <variant>

#include "runtime/settings/settings.h"

namespace gazeloop::report {

namespace fs = std::filesystem;

std::vector<NamedFile> files_of(const settings::Settings& settings) {
    std::vector<NamedFile> files;
    const auto add = [&files](std::string_view key, const fs::path& file) {
        std::error_code ignored;
        if (fs::is_regular_file(file, ignored)) {
            files.push_back({key, file});
        }
    };
    for (const settings::SettingRow& row : settings.rows()) {
        const std::string& origin = settings.origin(row.key);
        add(row.key, origin.substr(0, origin.rfind(':')));  // FILE:LINE
        const std::string value = settings::text_of(row);
        const auto* const path = std::get_if<settings::Path>(&row.slot);
        const auto* const choice = std::get_if<settings::Choice>(&row.slot);
        if ((path != nullptr && path->is_file(value)) ||
            (choice != nullptr && choice->is_file(value))) {
            add(row.key, value);
        }
    }
    return files;
}

Expected<void> check_apart(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs) {
    const auto same = [](const fs::path& a, const fs::path& b) {
        std::error_code missing;
        return a == b || files::followed(a) == files::followed(b) || fs::equivalent(a, b, missing);
    };
    const auto in_folder = [](const fs::path& file, const fs::path& folder) {
        std::error_code missing;
        return fs::is_directory(folder, missing) && fs::exists(file, missing) &&
               fs::equivalent(files::followed(file).parent_path(), folder, missing);
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
            if (file != "-" && !read.file.empty() &&
                (same(read.file, file) || in_folder(file, read.file))) {
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

Expected<void> check_outputs(std::span<const NamedFile> outputs,
                             std::span<const NamedFile> inputs) {
    if (auto apart = check_apart(outputs, inputs); !apart) {
        return apart;
    }
    for (const NamedFile& output : outputs) {
        if (!output.file.empty()) {
            if (auto writable = check_output(output.file); !writable) {
                return writable;
            }
        }
    }
    return {};
}

}  // namespace gazeloop::report
