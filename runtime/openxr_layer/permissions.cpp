#include "runtime/openxr_layer/permissions.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <sstream>
#include <system_error>
#include <utility>

#include "runtime/openxr_layer/layer_log.h"
#include "runtime/openxr_layer/private_file.h"
#include "runtime/openxr_layer/user_folders.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::size_t kMostListBytes = 1'000'000;
constexpr std::chrono::milliseconds kLookAgain{500};

using Answer = Permissions::Answer;
constexpr std::array<std::pair<std::string_view, Answer>, 3> kAnswers{
    {{"allow", Answer::Allowed}, {"foveation", Answer::FoveationOnly}, {"deny", Answer::Denied}}};

}  // namespace

std::optional<std::filesystem::path> Permissions::file() {
    auto folder = user_config();
    return folder ? std::optional(*folder / "gazeloop/layer-applications.toml") : std::nullopt;
}

Expected<Permissions> Permissions::read(const std::filesystem::path& file) {
    std::error_code failure;
    if (!std::filesystem::exists(file, failure) && !failure) {
        return Permissions{};
    }
    const auto text = read_small(file, kMostListBytes);
    if (!text) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: cannot be read, or is larger than 1 MB", file.string())});
    }
    return parse(*text, file.string());
}

Expected<Permissions> Permissions::parse(std::string_view text, std::string_view name) {
    const auto refuse = [&](const toml::source_region& where, std::string_view why) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}:{}: {}", name, where.begin.line, why)});
    };
    Permissions permissions;
    try {
        for (const auto& [key, node] : toml::parse(text, name)) {
            const auto found = std::ranges::find(kAnswers, node.value_or(std::string_view{}),
                                                 &decltype(kAnswers)::value_type::first);
            if (found == kAnswers.end()) {
                return refuse(node.source(),
                              "\"EXECUTABLE\" = \"allow\", \"foveation\" or \"deny\" is expected");
            }
            permissions.set(std::string(key.str()), found->second);
        }
    } catch (const toml::parse_error& error) {
        return refuse(error.source(), error.description());
    }
    return permissions;
}

Permissions::Answer Permissions::of(std::string_view executable) const {
    const auto found = answers_.find(executable);
    return found != answers_.end() ? found->second : Answer::Unknown;
}

void Permissions::set(const std::string& executable, Answer answer) {
    if (answer == Answer::Unknown) {
        answers_.erase(executable);
    } else {
        answers_[executable] = answer;
    }
}

std::string Permissions::text() const {
    toml::table table;
    for (const auto& [executable, answer] : answers_) {
        table.insert(
            executable,
            std::ranges::find(kAnswers, answer, &decltype(kAnswers)::value_type::second)->first);
    }
    std::ostringstream out;
    out << table << '\n';
    return out.str();
}

GazePermission::GazePermission(std::string executable, std::string_view unknown)
    : executable_(std::move(executable)),
      unknown_(unknown == "allow"       ? Verdict::Allowed
               : unknown == "foveation" ? Verdict::FoveationOnly
               : unknown == "ask"       ? Verdict::Asked
                                        : Verdict::Denied),
      file_(Permissions::file()) {
    look();
    thread_.emplace(kLookAgain, [this] { look(); });
}

void GazePermission::look() {
    try {
        Version now{.time = std::filesystem::file_time_type::min()};
        std::error_code absent;
        if (file_) {
            now.time = std::filesystem::last_write_time(*file_, absent);
            now.size = std::filesystem::file_size(*file_, absent);
        }
        if (seen_ == now) {
            return;
        }
        seen_ = now;
        verdict_.store(read(), std::memory_order_relaxed);
    } catch (...) {  // out of memory: no words are made of it
        verdict_.store(Verdict::Denied, std::memory_order_relaxed);
        say(LogLevel::Warning, "permissions cannot be read: no application gets gaze");
    }
}

GazePermission::Verdict GazePermission::read() const {
    const auto permissions = file_ ? Permissions::read(*file_) : Permissions{};
    if (!permissions) {
        say(LogLevel::Warning, permissions.error().message + ": no application gets gaze");
        return Verdict::Denied;
    }
    switch (permissions->of(executable_)) {
        case Permissions::Answer::Unknown:
            return unknown_;
        case Permissions::Answer::Allowed:
            return Verdict::Allowed;
        case Permissions::Answer::FoveationOnly:
            return Verdict::FoveationOnly;
        case Permissions::Answer::Denied:
            return Verdict::Denied;
    }
    return Verdict::Denied;
}

}  // namespace gazeloop::openxr_layer
