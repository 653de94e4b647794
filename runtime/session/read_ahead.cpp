#include "runtime/session/read_ahead.h"

#include <string>
#include <utility>

namespace gazeloop::session {
namespace {

class Teller {
  public:
    explicit Teller(frame::FrameObserver& observer) : observer_(observer) {}
    void operator()(const gaze::HiddenChange& change) const { observer_.on_hidden(change); }
    void operator()(const gaze::OriginChange& change) const { observer_.on_origin(change); }
    void operator()(const RecordedSample& one) const { observer_.on_sample(one.sample, one.frame); }
    void operator()(const RecordedEvent& event) const {
        observer_.on_event(event.time, event.kind, event.text);
    }
    void operator()(const frame::FrameRecord& record) const { observer_.on_frame(record); }
    void operator()(const frame::FrameGpuRecord& record) const { observer_.on_gpu(record); }
    void operator()(const frame::FrameGaze& gaze) const { observer_.on_gaze(gaze); }

  private:
    frame::FrameObserver& observer_;
};

}  // namespace

bool ReadAhead::give(Batch& batch) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopped_ || full_.size() < kMostBatches; });
    if (stopped_) {
        return false;
    }
    full_.push_back(std::exchange(batch, {}));
    if (!empty_.empty()) {
        batch = std::move(empty_.back());
        empty_.pop_back();
    }
    changed_.notify_all();
    return true;
}

void ReadAhead::end(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    ended_ = true;
    changed_.notify_all();
}

bool ReadAhead::take(Batch& batch) {
    batch.clear();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || !full_.empty(); });
    if (full_.empty()) {
        if (failure_) {
            std::rethrow_exception(std::exchange(failure_, nullptr));
        }
        return false;
    }
    empty_.push_back(std::exchange(batch, std::move(full_.front())));
    full_.erase(full_.begin());
    changed_.notify_all();
    return true;
}

void ReadAhead::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

void tell(frame::FrameObserver& observer, const Told& told) { std::visit(Teller(observer), told); }

ReadAheadObserver::ReadAheadObserver(ReadAhead& ahead) : ahead_(ahead) {
    batch_.reserve(ReadAhead::kBatch);
}

void ReadAheadObserver::on_sample(const gaze::GazeSample& sample, std::uint64_t frame) {
    add(RecordedSample{frame, sample});
}

void ReadAheadObserver::on_event(time::Stamp time, std::string_view kind, std::string_view text) {
    add(RecordedEvent{time, std::string(kind), std::string(text)});
}

void ReadAheadObserver::flush() {
    if (!ahead_.give(batch_)) {
        throw Stopped{};
    }
    batch_.reserve(ReadAhead::kBatch);
}

}  // namespace gazeloop::session
