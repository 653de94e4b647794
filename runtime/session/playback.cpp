#include "runtime/session/playback.h"

#include <array>
#include <exception>
#include <limits>
#include <thread>
#include <utility>

#include "runtime/session/read_ahead.h"
#include "runtime/session/reading_error.h"
#include "runtime/session/row_readers.h"
#include "runtime/session/statement.h"

namespace gazeloop::session {
namespace {

/// A reader that is already at its next row.
template <typename Rows>
class Ahead {
  public:
    explicit Ahead(const OpenSession& session)
        : rows_(session.database(), session.info().schema_version), more_(rows_.next()) {}

    /// Tells the rows from here on, while they are due.
    template <typename Due, typename Tell>
    void tell_while(const Due& due, const Tell& tell) {
        while (more_ && due(rows_.row())) {
            tell(rows_.row());
            more_ = rows_.next();
        }
    }

  private:
    Rows rows_;
    bool more_;
};

class Player {
  public:
    Player(const OpenSession& session, std::span<frame::FrameObserver* const> observers,
           PlayedGaze gaze)
        : observers_(observers),
          frames_(session.database(), session.info().schema_version),
          hidden_(session),
          origins_(session),
          events_(session) {
        if (gaze == PlayedGaze::Samples) {
            samples_.emplace(session);
        }
    }

    PlaybackEnd run() {
        while (frames_.next()) {
            const RecordedFrame& recorded = frames_.row();
            const std::uint64_t index = recorded.frame.index;
            tell_before(index, recorded.frame.stamps.end_frame.ns);
            tell([&](frame::FrameObserver& observer) { observer.on_frame(recorded.frame); });
            if (recorded.gpu_known) {
                tell([&](frame::FrameObserver& observer) { observer.on_gpu(recorded.gpu); });
            }
            if (!samples_) {
                const frame::FrameGaze gaze{index, recorded.gaze.value_or(frame::GazeCounts{}),
                                            recorded.gaze_error};
                tell([&](frame::FrameObserver& observer) { observer.on_gaze(gaze); });
            }
            end_.last_frame = index;
        }
        tell_before(std::numeric_limits<std::uint64_t>::max(),
                    std::numeric_limits<std::int64_t>::max());
        return std::move(end_);
    }

  private:
    template <typename Call>
    void tell(const Call& call) const {
        for (frame::FrameObserver* const observer : observers_) {
            call(*observer);
        }
    }

    /// Tells what comes before this frame, which ended at `end_ns`.
    void tell_before(std::uint64_t frame, std::int64_t end_ns) {
        const auto due = [&](const auto& piece) { return piece.frame <= frame; };
        hidden_.tell_while(due, [this](const gaze::HiddenChange& change) {
            tell([&](frame::FrameObserver& observer) { observer.on_hidden(change); });
        });
        origins_.tell_while(due, [this](const gaze::OriginChange& change) {
            tell([&](frame::FrameObserver& observer) { observer.on_origin(change); });
        });
        if (samples_) {
            samples_->tell_while(due, [this](const RecordedSample& one) {
                tell([&](frame::FrameObserver& observer) {
                    observer.on_sample(one.sample, one.frame);
                });
            });
        }
        events_.tell_while(
            [&](const RecordedEvent& event) {
                return !event.time.known() || event.time.ns <= end_ns;
            },
            [this](const RecordedEvent& event) { tell_event(event); });
    }

    void tell_event(const RecordedEvent& event) {
        if (event.kind == frame::kErrorEvent.name) {
            end_.last_error = event.text;
        }
        tell([&](frame::FrameObserver& observer) {
            observer.on_event(event.time, event.kind, event.text);
        });
    }

    std::span<frame::FrameObserver* const> observers_;
    FrameRows frames_;
    Ahead<HiddenRows> hidden_;
    Ahead<OriginRows> origins_;
    std::optional<Ahead<SampleRows>> samples_;
    Ahead<EventRows> events_;
    PlaybackEnd end_;
};

}  // namespace

Expected<bool> has_gaze_counts(const OpenSession& session) {
    try {
        const Database& database = session.database();
        if (!has_table(database, "gaze") || !has_table(database, "frame") ||
            !has_column(database, "frame", "gaze_received")) {
            return false;
        }
        // Numbers of frames are unsigned, and positions count from 1.
        Statement ask(database,
                      "SELECT coalesce((SELECT max(position) FROM gaze), 0) = coalesce("
                      "(SELECT gaze_received FROM frame WHERE number < 0 ORDER BY number DESC "
                      "LIMIT 1), (SELECT gaze_received FROM frame ORDER BY number DESC LIMIT 1), "
                      "0)");
        return ask.next() && ask.integer(0) == 1;
    } catch (...) {
        return std::unexpected(reading_error(session.file()));
    }
}

Expected<PlaybackEnd> play(const OpenSession& session,
                           std::span<frame::FrameObserver* const> observers, PlayedGaze gaze) {
    try {
        return Player(session, observers, gaze).run();
    } catch (...) {
        return std::unexpected(reading_error(session.file()));
    }
}

Expected<PlaybackEnd> play_ahead(const OpenSession& session,
                                 std::span<frame::FrameObserver* const> observers,
                                 PlayedGaze gaze) {
    ReadAhead ahead;
    PlaybackEnd end;
    std::thread reader([&] {
        try {
            ReadAheadObserver relay(ahead);
            const std::array<frame::FrameObserver*, 1> relays{&relay};
            end = Player(session, relays, gaze).run();
            relay.flush();
            ahead.end(nullptr);
        } catch (const ReadAheadObserver::Stopped&) {
            ahead.end(nullptr);
        } catch (...) {
            ahead.end(std::current_exception());
        }
    });
    std::exception_ptr failure;
    try {
        for (ReadAhead::Batch batch; ahead.take(batch);) {
            for (const Told& told : batch) {
                for (frame::FrameObserver* const observer : observers) {
                    tell(*observer, told);
                }
            }
        }
    } catch (...) {
        failure = std::current_exception();
        ahead.stop();
    }
    reader.join();
    if (!failure) {
        return end;
    }
    try {
        std::rethrow_exception(failure);
    } catch (...) {
        return std::unexpected(reading_error(session.file()));
    }
}

Expected<PlaybackEnd> play(const std::filesystem::path& session,
                           std::span<frame::FrameObserver* const> observers) {
    const Expected<OpenSession> open = OpenSession::open(session);
    if (!open) {
        return std::unexpected(open.error());
    }
    return play(*open, observers);
}

}  // namespace gazeloop::session
