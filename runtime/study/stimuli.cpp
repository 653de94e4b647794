#include "runtime/study/stimuli.h"

#include <fmt/core.h>

#include <algorithm>

namespace gazeloop::study {
namespace {

/// Names of both, in the order in which they come. Throws SetupError (Usage).
frame::NameList together(const frame::NameList& first, const frame::NameList& second,
                         std::size_t most, std::string_view what) {
    std::string text = first.text();
    for (const std::string& name : second.names()) {
        if (!first.find(name)) {
            text += (text.empty() ? "" : " ") + name;
        }
    }
    auto all = frame::NameList::parse(text, most);
    if (!all) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("the study's methods have more {} together than a session can "
                                     "keep ({}): {}",
                                     what, most, text));
    }
    return std::move(*all);
}

void require_all(const frame::NameList& all, const frame::NameList& some,
                 const Stimulus& stimulus) {
    for (const std::string& name : some.names()) {
        if (!all.find(name)) {
            throw SetupError(ErrorKind::Usage,
                             fmt::format("{} {} draws '{}', which the study's first pictures do "
                                         "not: its parts cannot be recorded side by side",
                                         stimulus.method, stimulus.settings_text(), name));
        }
    }
}

}  // namespace

std::string Stimulus::settings_text() const {
    std::string text;
    for (const auto& [key, value] : settings) {
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, value);
    }
    return text;
}

Stimuli::Stimuli(MakeStimulus make, const std::vector<Stimulus>& samples) : make_(std::move(make)) {
    for (const Stimulus& sample : samples) {
        std::unique_ptr<render::FrameRenderer> renderer = make_(sample);
        passes_ = together(passes_, renderer->passes(), frame::kMostPasses, "passes");
        grids_ = together(grids_, renderer->grids(), frame::kMostGrids, "grids");
        made_.push_front({sample, std::move(renderer)});
    }
}

render::FrameRenderer& Stimuli::of(const Stimulus& stimulus) {
    const auto found = std::ranges::find(made_, stimulus, &Made::stimulus);
    if (found != made_.end()) {
        made_.splice(made_.begin(), made_, found);
        return *made_.front().renderer;
    }
    std::unique_ptr<render::FrameRenderer> renderer = make_(stimulus);
    require_all(passes_, renderer->passes(), stimulus);
    require_all(grids_, renderer->grids(), stimulus);
    made_.push_front({stimulus, std::move(renderer)});
    if (made_.size() > kMost) {
        made_.back().renderer->wait_idle();
        made_.pop_back();
    }
    return *made_.front().renderer;
}

frame::SampleCounts Stimuli::in_run(const render::FrameRenderer& renderer,
                                    const frame::SampleCounts& counts) const {
    frame::SampleCounts placed = counts;
    placed.grids.fill({});
    placed.grid_count = static_cast<std::uint32_t>(grids_.size());
    for (std::size_t grid = 0; grid < counts.grid_count; ++grid) {
        placed.grids[*grids_.find(renderer.grids()[grid])] = counts.grids[grid];
    }
    return placed;
}

frame::FrameGpuRecord Stimuli::in_run(const render::FrameRenderer& renderer,
                                      const frame::FrameGpuRecord& record) const {
    frame::FrameGpuRecord placed = record;
    placed.passes = {};
    placed.pass_starts = {};
    for (std::size_t pass = 0; pass < renderer.passes().size(); ++pass) {
        const std::size_t place = *passes_.find(renderer.passes()[pass]);
        placed.passes.set(place, record.passes[pass]);
        placed.pass_starts.set(place, record.pass_starts[pass]);
    }
    return placed;
}

}  // namespace gazeloop::study
