#include "runtime/session/session_recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "runtime/session/database.h"
#include "runtime/session/record.h"
#include "runtime/session/session_writer.h"
#include "runtime/session/spsc_queue.h"

namespace gazeloop::session {
namespace {

/// 26 seconds of a 1000 Hz tracker and a 120 Hz display, 22 MB.
constexpr std::size_t kQueueRecords = 32'768;

/// Half of what is promised, so that a late wake-up of the thread breaks no promise.
constexpr std::chrono::milliseconds kCommitInterval{25};

/// Threads started in its lifetime take no signals: those are for the loop. A file size limit then
/// is an error to report and no reason to die.
class SignalsBlocked {
  public:
    SignalsBlocked() {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    SignalsBlocked(const SignalsBlocked&) = delete;
    SignalsBlocked& operator=(const SignalsBlocked&) = delete;
    ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

  private:
    sigset_t before_{};
};

Error bad_input(std::string message) { return {ExitCode::BadInput, std::move(message)}; }

/// Creates the empty file, which must be new.
std::optional<Error> create_file(const std::filesystem::path& file) {
    const int created = ::open(file.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
    if (created < 0 && errno == EEXIST) {
        return bad_input(
            fmt::format("{}: exists already; name another file or remove it", file.string()));
    }
    if (created < 0) {
        return bad_input(
            fmt::format("{}: cannot be created ({}); the folder must exist and be writable",
                        file.string(), std::generic_category().message(errno)));
    }
    ::close(created);
    // SQLite would delete what lies beside a session that was moved away, or take it for its own.
    for (const char* companion : {"-wal", "-shm", "-journal"}) {
        const std::filesystem::path beside = file.string() + companion;
        std::error_code ignored;
        if (std::filesystem::exists(beside, ignored)) {
            std::filesystem::remove(file, ignored);
            return bad_input(
                fmt::format("{}: belongs to an earlier session; remove it or name another file",
                            beside.string()));
        }
    }
    return std::nullopt;
}

}  // namespace

class SessionRecorder::Impl {
  public:
    Impl(std::filesystem::path file, const SessionHeader& header)
        : file_(std::move(file)), writer_(std::in_place, file_, header) {
        const SignalsBlocked blocked;
        thread_ = std::thread([this] { run(); });
    }

    template <typename T>
    void add(T&& record) {
        if (!failed() && !queue_.try_push(std::forward<T>(record))) {
            dropped_.fetch_add(1, std::memory_order_relaxed);
        }
    }

    [[nodiscard]] bool failed() const { return failed_.load(std::memory_order_acquire); }

    RecordingStatus close() {
        if (thread_.joinable()) {
            {
                const std::lock_guard lock(mutex_);
                closing_ = true;
            }
            wake_.notify_one();
            thread_.join();
        }
        return {dropped_.load(std::memory_order_relaxed), failure_};
    }

  private:
    void run() {
        std::string reason;
        try {
            while (!wait_for_close()) {
                write_queued();
            }
            write_queued();
            writer_->finish();
        } catch (const DatabaseError& error) {
            reason = error.what();
        }
        if (writer_->moved()) {
            reason = "was moved or removed while it was written";
        }
        writer_.reset();
        if (!reason.empty()) {
            failure_ = fmt::format("{}: recording ended early: {}", file_.string(), reason);
            failed_.store(true, std::memory_order_release);
        }
    }

    bool wait_for_close() {
        std::unique_lock lock(mutex_);
        return wake_.wait_for(lock, kCommitInterval, [this] { return closing_; });
    }

    void write_queued() {
        const Record* record = queue_.front();
        while (record != nullptr) {
            const auto commit_at = std::chrono::steady_clock::now() + kCommitInterval;
            writer_->begin();
            do {
                writer_->write(*record);
                queue_.pop();
                record = queue_.front();
            } while (record != nullptr && std::chrono::steady_clock::now() < commit_at);
            writer_->commit(dropped_.load(std::memory_order_relaxed));
        }
    }

    std::filesystem::path file_;
    SpscQueue<Record> queue_{kQueueRecords};
    std::atomic<std::uint64_t> dropped_{0};
    std::atomic<bool> failed_{false};
    std::string failure_;  ///< of the thread until it has been joined
    std::optional<SessionWriter> writer_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool closing_ = false;
    std::thread thread_;
};

Expected<std::unique_ptr<SessionRecorder>> SessionRecorder::create(
    const std::filesystem::path& file, const SessionHeader& header) {
    if (std::optional<Error> error = create_file(file)) {
        return std::unexpected(std::move(*error));
    }
    try {
        auto impl = std::make_unique<Impl>(file, header);
        return std::unique_ptr<SessionRecorder>(new SessionRecorder(std::move(impl)));
    } catch (const DatabaseError& error) {
        std::error_code ignored;
        std::filesystem::remove(file, ignored);
        return std::unexpected(
            bad_input(fmt::format("{}: cannot be written: {}", file.string(), error.what())));
    }
}

SessionRecorder::SessionRecorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

SessionRecorder::~SessionRecorder() { impl_->close(); }

void SessionRecorder::add(const gaze::GazeSample& sample, std::uint64_t frame) {
    impl_->add(SampleRecord{frame, sample});
}

void SessionRecorder::add(const latency::FrameRecord& record) { impl_->add(record); }

void SessionRecorder::add(const latency::FrameGpuRecord& record) { impl_->add(record); }

void SessionRecorder::event(latency::Stamp time, std::string_view kind, std::string_view text) {
    impl_->add(EventRecord{time, FixedText<32>(kind), FixedText<240>(text)});
}

bool SessionRecorder::failed() const { return impl_->failed(); }

RecordingStatus SessionRecorder::close() { return impl_->close(); }

}  // namespace gazeloop::session
