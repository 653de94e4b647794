#include <fcntl.h>
#include <fmt/core.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "runtime/doctor/checks.h"
#include "runtime/time/clock.h"

namespace gazeloop::doctor {
namespace {

constexpr double kBytesPerMb = 1e6;
constexpr double kLeastFreeMb = 1000.0;
/// The recorder commits ten times a second; a disk this slow fills its queue.
constexpr double kSlowSyncMs = 100.0;

/// A file that is gone when it is closed.
class ScratchFile {
  public:
    explicit ScratchFile(const std::filesystem::path& folder) {
        std::string name = (folder / ".gazeloop-doctor-XXXXXX").string();
        fd_ = mkostemp(name.data(), O_CLOEXEC);
        if (fd_ >= 0) {
            unlink(name.c_str());
        } else {
            failure_ = errno;
        }
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile() {
        if (fd_ >= 0) {
            close(fd_);
        }
    }
    [[nodiscard]] bool open() const { return fd_ >= 0; }
    [[nodiscard]] int failure() const { return failure_; }

    bool append(std::span<const char> bytes) {
        const ssize_t wrote = write(fd_, bytes.data(), bytes.size());
        failure_ = wrote < 0 ? errno : ENOSPC;
        return wrote == static_cast<ssize_t>(bytes.size());
    }
    bool sync() {
        const bool done = fdatasync(fd_) == 0;
        failure_ = errno;
        return done;
    }

  private:
    int fd_ = -1;
    int failure_ = 0;
};

Finding check_space(const std::filesystem::path& folder) {
    struct statvfs space{};
    if (statvfs(folder.c_str(), &space) != 0) {
        return {.check = "recording.space",
                .verdict = Verdict::Failure,
                .found = fmt::format("{}: {}", folder.string(), std::strerror(errno)),
                .remedy = "name an existing folder with --folder"};
    }
    const double free_mb =
        static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize) / kBytesPerMb;
    const bool enough = free_mb >= kLeastFreeMb;
    return {.check = "recording.space",
            .verdict = enough ? Verdict::Ok : Verdict::Warning,
            .found = fmt::format("{}: {:.0f} MB free", folder.string(), free_mb),
            .remedy = enough ? "" : "free some space there, or record into another folder",
            .facts = {{"folder", folder.string()}, {"free_mb", free_mb}}};
}

Finding check_writing(const std::filesystem::path& folder) {
    Finding finding{.check = "recording.write", .facts = {{"folder", folder.string()}}};
    const auto refused = [&](const char* what, int failure) {
        finding.verdict = Verdict::Failure;
        finding.found = fmt::format("{}: {} ({})", folder.string(), what, std::strerror(failure));
        finding.remedy = failure == ENOSPC || failure == EDQUOT
                             ? "free some space there, or record into another folder"
                             : "record into a folder that you may write to";
        return finding;
    };
    ScratchFile file(folder);
    if (!file.open()) {
        return refused("no file can be made", file.failure());
    }
    // As the recorder writes: a little, and then it has to be on the disk.
    constexpr int kSyncs = 20;
    constexpr std::size_t kPageBytes = 4096;
    constexpr std::size_t kChunkBytes = 1U << 20U;
    constexpr int kChunks = 16;
    const std::vector<char> chunk(kChunkBytes, 'x');
    std::vector<double> syncs_ms;
    for (int i = 0; i < kSyncs; ++i) {
        const std::int64_t begin_ns = time::monotonic_ns();
        if (!file.append(std::span(chunk).first(kPageBytes)) || !file.sync()) {
            return refused("writing failed", file.failure());
        }
        syncs_ms.push_back(static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-6);
    }
    const std::int64_t begin_ns = time::monotonic_ns();
    for (int i = 0; i < kChunks; ++i) {
        if (!file.append(chunk)) {
            return refused("writing failed", file.failure());
        }
    }
    if (!file.sync()) {
        return refused("writing failed", file.failure());
    }
    const double mb_per_s = kChunks * static_cast<double>(kChunkBytes) / kBytesPerMb /
                            (static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-9);
    std::ranges::sort(syncs_ms);
    const double median_ms = syncs_ms[syncs_ms.size() / 2];
    const double longest_ms = syncs_ms.back();
    finding.found = fmt::format(
        "a write reaches the disk in {:.2f} ms (median of {}), {:.2f} ms at "
        "most; {:.0f} MB/s",
        median_ms, kSyncs, longest_ms, mb_per_s);
    finding.facts.update({{"sync_median_ms", median_ms},
                          {"sync_longest_ms", longest_ms},
                          {"write_mb_per_s", mb_per_s}});
    if (longest_ms > kSlowSyncMs) {
        finding.verdict = Verdict::Warning;
        finding.remedy = "record onto a local solid-state disk, not a network or memory card";
    }
    return finding;
}

}  // namespace

Findings check_recording_folder(const std::filesystem::path& folder) {
    std::error_code ignored;
    const std::filesystem::path whole = std::filesystem::absolute(folder, ignored);
    return {check_space(whole), check_writing(whole)};
}

}  // namespace gazeloop::doctor
