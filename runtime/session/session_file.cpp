#include "runtime/session/session_file.h"

#include <array>
#include <utility>

#include "runtime/session/playback.h"

namespace gazeloop::session {
namespace {

class Collector final : public frame::FrameObserver {
  public:
    explicit Collector(SessionFile& session) : session_(session) {}
    void on_hidden(const gaze::HiddenChange& change) override { session_.hidden.push_back(change); }
    void on_origin(const gaze::OriginChange& change) override {
        session_.origins.push_back(change);
    }
    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override {
        session_.samples.push_back({frame, sample});
    }
    void on_frame(const frame::FrameRecord& record) override {
        RecordedFrame& frame = session_.frames.emplace_back();
        frame.frame = record;
        frame.gpu.index = record.index;
    }
    void on_gpu(const frame::FrameGpuRecord& record) override {
        session_.frames.back().gpu = record;
        session_.frames.back().gpu_known = true;
    }
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override {
        session_.events.push_back({time, std::string(kind), std::string(text)});
    }

  private:
    SessionFile& session_;
};

}  // namespace

Expected<SessionFile> read_session(const std::filesystem::path& file) {
    const Expected<OpenSession> open = OpenSession::open(file);
    if (!open) {
        return std::unexpected(open.error());
    }
    SessionFile session;
    static_cast<SessionInfo&>(session) = open->info();
    Collector collector(session);
    const std::array<frame::FrameObserver*, 1> observers{&collector};
    if (auto end = play(*open, observers); !end) {
        return std::unexpected(std::move(end.error()));
    }
    return session;
}

}  // namespace gazeloop::session
