#include "runtime/session/session_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <tuple>
#include <utility>

#include "runtime/session/new_session.h"
#include "runtime/session/record.h"
#include "runtime/session/record_fields.h"
#include "runtime/session/session_writer.h"
#include "runtime/signals_blocked.h"
#include "runtime/spsc_queue.h"

namespace gazeloop::session {
namespace {

/// 26 seconds of a 1000 Hz tracker and a 120 Hz display, 22 MB.
constexpr std::size_t kQueueRecords = 32'768;

/// The longest wait for records, and the longest transaction. Together they are 50 ms, half of the
/// promised 100 ms, so that a late wake-up of the thread does not break the promise.
constexpr std::chrono::milliseconds kCommitInterval{25};

}  // namespace

class SessionRecorder::Impl {
  public:
    Impl(std::filesystem::path file, WhenFull when_full)
        : file_(std::move(file)), when_full_(when_full), writer_(std::in_place, file_) {
        const SignalsBlocked blocked;
        thread_ = std::thread([this] { run(); });
    }

    template <typename T>
    void add(const T& record) {
        add(record, when_full_);
    }

    template <typename T>
    void add(const T& record, WhenFull when_full) {
        constexpr std::chrono::milliseconds kLook{1};
        while (!failed_.load(std::memory_order_acquire) && !queue_.try_push(record)) {
            if (when_full == WhenFull::Drop) {
                dropped_.fetch_add(1, std::memory_order_relaxed);
                return;
            }
            std::this_thread::sleep_for(kLook);
        }
    }

    void add_lost(std::uint64_t records) { dropped_.fetch_add(records, std::memory_order_relaxed); }

    bool wait_until_written(std::chrono::milliseconds patience) {
        std::unique_lock lock(mutex_);
        const std::uint64_t asked = ++writes_asked_;
        wake_.notify_one();
        written_.wait_for(lock, patience, [&] { return writes_done_ >= asked || in_trouble(); });
        return writes_done_ >= asked && !in_trouble();
    }

    RecordingStatus close() {
        end();
        return {dropped_.load(std::memory_order_relaxed), failure()};
    }

    [[nodiscard]] bool in_trouble() const {
        return moved_.load(std::memory_order_relaxed) || failed_.load(std::memory_order_acquire);
    }

    [[nodiscard]] std::string trouble() const { return in_trouble() ? failure() : std::string(); }

    void end() {
        if (thread_.joinable()) {
            {
                const std::lock_guard lock(mutex_);
                closing_ = true;
            }
            wake_.notify_one();
            thread_.join();
        }
    }

  private:
    /// Nothing here may throw, even out of memory. So the message is made when it is asked for.
    void run() {
        try {
            for (bool closing = false; !closing;) {
                std::uint64_t asked = 0;
                std::tie(closing, asked) = wait_for_work();
                write_queued();
                tell_written(asked);
            }
            write_count_of_lost();
            writer_->finish();
        } catch (const std::exception&) {
            failure_ = std::current_exception();
        }
        look_for_file();
        if (failure_ && !moved_) {
            mark_failed();
        }
        writer_.reset();
        failed_.store(failure_ || moved_, std::memory_order_release);
        tell_written(0);
    }

    /// Whoever waits for that looks again.
    void tell_written(std::uint64_t asked) {
        {
            const std::lock_guard lock(mutex_);
            writes_done_ = std::max(writes_done_, asked);
        }
        written_.notify_all();
    }

    void look_for_file() {
        if (writer_->moved()) {
            moved_.store(true, std::memory_order_relaxed);
        }
    }

    void mark_failed() {
        try {
            writer_->mark_failed();
        } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch)
            // The file then says that it was not closed, which is true as well.
        }
    }

    [[nodiscard]] std::string failure() const {
        const auto message = [this](std::string_view reason) {
            return fmt::format("{}: recording ended early: {}", file_.string(), reason);
        };
        if (moved_) {
            return message(
                "was moved or removed while it was written (if it was moved, it is whole there)");
        }
        try {
            if (failed_.load(std::memory_order_acquire) && failure_) {
                std::rethrow_exception(failure_);
            }
            return {};
        } catch (const std::exception& error) {
            return message(fmt::format(
                "{}: what came before is in it; free space there, or record to another folder",
                error.what()));
        }
    }

    /// Gives whether to close, and what has been asked for by then.
    std::pair<bool, std::uint64_t> wait_for_work() {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, kCommitInterval,
                       [this] { return closing_ || writes_asked_ > writes_done_; });
        return {closing_, writes_asked_};
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
            look_for_file();
        }
    }

    /// Where nothing came after the last loss, no transaction has told the file of it.
    void write_count_of_lost() {
        if (const std::uint64_t lost = dropped_.load(std::memory_order_relaxed); lost > 0) {
            writer_->begin();
            writer_->commit(lost);
        }
    }

    std::filesystem::path file_;
    WhenFull when_full_;
    SpscQueue<Record> queue_{kQueueRecords};
    std::atomic<std::uint64_t> dropped_{0};
    std::atomic<bool> failed_{false};
    std::exception_ptr failure_;  ///< of the thread until failed_ is set
    std::atomic<bool> moved_{false};
    std::optional<SessionWriter> writer_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable written_;
    std::uint64_t writes_asked_ = 0;  ///< calls of wait_until_written()
    std::uint64_t writes_done_ = 0;   ///< of these
    bool closing_ = false;
    std::thread thread_;
};

Expected<std::unique_ptr<SessionRecorder>> SessionRecorder::create(
    const std::filesystem::path& file, const SessionHeader& header, WhenFull when_full) {
    if (std::optional<Error> error = create_session(file, header)) {
        return std::unexpected(std::move(*error));
    }
    try {
        auto impl = std::make_unique<Impl>(file, when_full);
        return std::unique_ptr<SessionRecorder>(new SessionRecorder(std::move(impl)));
    } catch (const std::exception& error) {  // SQLite, memory, or the thread
        remove_session(file);
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: cannot be recorded: {}", file.string(), error.what())});
    }
}

Expected<void> SessionRecorder::check(const std::filesystem::path& file) {
    if (std::optional<Error> error = refuse_session(file)) {
        return std::unexpected(std::move(*error));
    }
    return {};
}

SessionRecorder::SessionRecorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

SessionRecorder::~SessionRecorder() { impl_->end(); }

void SessionRecorder::add(const gaze::GazeSample& sample, std::uint64_t frame) {
    impl_->add(SampleRecord{frame, sample});
}

void SessionRecorder::add(const frame::FrameRecord& record) { impl_->add(record); }

void SessionRecorder::add(const frame::FrameGpuRecord& record) { impl_->add(record); }

void SessionRecorder::add(const gaze::HiddenChange& change) {
    bool any = false;
    for (const gaze::Eye eye : gaze::kEyes) {
        if (change.meshes == nullptr) {
            continue;
        }
        for (const gaze::HiddenTriangle& triangle : (*change.meshes)[gaze::index(eye)]) {
            impl_->add(HiddenRecord{change.frame, eye, triangle});
            any = true;
        }
    }
    if (!any) {
        impl_->add(HiddenRecord{change.frame, gaze::Eye::Left, no_triangle()});
    }
}

void SessionRecorder::add(const gaze::OriginChange& change) { impl_->add(change); }

void SessionRecorder::add(const TrialRecord& record) { impl_->add(record, WhenFull::Wait); }

void SessionRecorder::add(const ResponseRecord& record) { impl_->add(record, WhenFull::Wait); }

void SessionRecorder::event(time::Stamp time, std::string_view kind, std::string_view text) {
    impl_->add(EventRecord{time, FixedText<32>(kind), FixedText<240>(text)});
}

void SessionRecorder::add_lost(std::uint64_t records) { impl_->add_lost(records); }

bool SessionRecorder::wait_until_written(std::chrono::milliseconds patience) {
    return impl_->wait_until_written(patience);
}

bool SessionRecorder::in_trouble() const { return impl_->in_trouble(); }

std::string SessionRecorder::trouble() const { return impl_->trouble(); }

RecordingStatus SessionRecorder::close() { return impl_->close(); }

}  // namespace gazeloop::session
