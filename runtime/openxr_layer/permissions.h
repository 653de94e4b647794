#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::openxr_layer {

/// Whether applications get gaze, by their executables: what the user decided.
class Permissions {
  public:
    enum class Answer : std::uint8_t {
        Unknown,
        Allowed,
        FoveationOnly,  ///< pictures may follow the gaze, which is not told
        Denied
    };

    /// layer-applications.toml among the user's settings; none where there is no home.
    [[nodiscard]] static std::optional<std::filesystem::path> file();

    /// An absent file: nothing is decided. Errors (BadInput): the file, the line, what is wrong.
    static Expected<Permissions> read(const std::filesystem::path& file);
    static Expected<Permissions> parse(std::string_view text, std::string_view name);

    [[nodiscard]] Answer of(std::string_view executable) const;
    void set(const std::string& executable, Answer answer);

    /// TOML, as parse() takes it.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] const std::map<std::string, Answer, std::less<>>& all() const { return answers_; }

  private:
    std::map<std::string, Answer, std::less<>> answers_;
};

/// Whether one application may have gaze, now: the file is looked at again when it has changed, so
/// that a decision counts in a program that runs.
class GazePermission {
  public:
    enum class Verdict : std::uint8_t { Allowed, FoveationOnly, Denied, Asked };

    /// `unknown`: layer.unknown_applications.
    GazePermission(std::string executable, std::string_view unknown);

    /// Looks at the file at most once a second. A file that cannot be read denies.
    [[nodiscard]] Verdict verdict(std::int64_t now_ns);

  private:
    void look();

    std::string executable_;
    Verdict unknown_;
    Verdict verdict_ = Verdict::Denied;
    std::optional<std::filesystem::path> file_;
    std::optional<std::filesystem::file_time_type> seen_;
    std::optional<std::int64_t> looked_ns_;
};

}  // namespace gazeloop::openxr_layer
