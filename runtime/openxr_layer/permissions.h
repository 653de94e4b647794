#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/periodic_thread.h"

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

/// Whether one application may have gaze, now. A thread of its own looks at the file twice a
/// second, so that a decision counts within a second in a program that runs, and no call of the
/// application's waits for a file.
class GazePermission {
  public:
    enum class Verdict : std::uint8_t { Allowed, FoveationOnly, Denied, Asked };

    /// `unknown`: layer.unknown_applications. Looks at once. Throws std::system_error where there
    /// is no thread for it.
    GazePermission(std::string executable, std::string_view unknown);

    /// A file that cannot be read denies. From any thread.
    [[nodiscard]] Verdict verdict() const { return verdict_.load(std::memory_order_relaxed); }

  private:
    /// Where the file has changed.
    void look();
    [[nodiscard]] Verdict read() const;

    std::string executable_;
    Verdict unknown_;
    std::atomic<Verdict> verdict_{Verdict::Denied};
    std::optional<std::filesystem::path> file_;
    struct Version {
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;  ///< two changes may come within what file times can tell apart
        friend bool operator==(const Version&, const Version&) = default;
    };
    std::optional<Version> seen_;
    std::optional<PeriodicThread> thread_;  // the first to end
};

}  // namespace gazeloop::openxr_layer
