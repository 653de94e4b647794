#include "runtime/report/perfetto/event_drawing.h"

#include <algorithm>
#include <utility>

#include "runtime/frame/event.h"

namespace gazeloop::report::perfetto {
namespace {

Subject subject_of(std::string_view kind) {
    if (kind.starts_with("budget")) {
        return Subject::Budget;
    }
    return kind == frame::kGazeEvent.name ? Subject::GazeEvents : Subject::Events;
}

}  // namespace

EventDrawing::EventDrawing(TraceWriter& writer, Drawing& drawing)
    : drawing_(drawing),
      sample_(writer.name("sample")),
      invalid_(writer.name("sample, no eye valid")),
      lost_(writer.name("lost")),
      out_of_order_(writer.name("out of order")),
      frames_lacking_(writer.name("frames lacking")),
      text_(writer.key("text")),
      sequence_(writer.key("sequence")),
      count_(writer.key("count")) {}

void EventDrawing::add(const time::Stamp& time, std::string_view kind, std::string_view text) {
    const auto place = drawing_.instant(subject_of(kind), kind, time);
    drawing_.annotate(place, text_, text);
    drawing_.write();
}

void EventDrawing::add(const gaze::GazeSample& sample, bool each) {
    const latency::GazeCounts before = counter_.counts();
    counter_.add(sample);
    const latency::GazeCounts& now = counter_.counts();
    const time::Stamp& at = sample.arrived.known() ? sample.arrived : sample.sampled;
    if (now.lost > before.lost) {
        add_count(Subject::Samples, lost_, now.lost - before.lost, at);
    }
    if (now.out_of_order > before.out_of_order) {
        drawing_.annotate(drawing_.instant(Subject::Samples, out_of_order_, at), sequence_,
                          sample.sequence);
    }
    if (each) {
        const NameId name = now.invalid > before.invalid ? invalid_ : sample_;
        drawing_.annotate(drawing_.instant(Subject::Samples, name, at), sequence_, sample.sequence);
    }
    drawing_.write();
}

void EventDrawing::add(const frame::GazeCounts& counts, const time::Stamp& at) {
    const frame::GazeCounts before = std::exchange(told_, counts);
    if (counts.lost > before.lost) {
        add_count(Subject::Samples, lost_, counts.lost - before.lost, at);
    }
    if (counts.out_of_order > before.out_of_order) {
        add_count(Subject::Samples, out_of_order_, counts.out_of_order - before.out_of_order, at);
    }
    drawing_.write();
}

void EventDrawing::add_frame(std::uint64_t index, const time::Stamp& at) {
    const auto before = std::exchange(last_frame_, index);
    if (before && index > *before + 1) {
        add_count(Subject::Events, frames_lacking_, index - *before - 1, at);
        drawing_.write();
    }
}

void EventDrawing::add_count(Subject subject, NameId name, std::uint64_t count,
                             const time::Stamp& at) {
    drawing_.annotate(drawing_.instant(subject, name, at), count_, count);
}

}  // namespace gazeloop::report::perfetto
