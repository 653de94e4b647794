#include "runtime/study/stimuli.h"

#include <fmt/core.h>

#include <algorithm>

namespace gazeloop::study {
namespace {

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

std::string_view Stimulus::scene() const {
    const auto found =
        std::ranges::find(settings, "render.scene", [](const auto& one) { return one.first; });
    return found == settings.end() ? std::string_view() : std::string_view(found->second);
}

Stimuli::Stimuli(MakeStimulus make, const std::vector<Stimulus>& samples) : make_(std::move(make)) {
    for (const Stimulus& sample : samples) {
        std::unique_ptr<render::FrameRenderer> renderer = make_(sample);
        lists_.add(*renderer);
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
    require_all(lists_.passes(), renderer->passes(), stimulus);
    require_all(lists_.grids(), renderer->grids(), stimulus);
    made_.push_front({stimulus, std::move(renderer)});
    if (made_.size() > kMost) {
        made_.back().renderer->wait_idle();
        made_.pop_back();
    }
    return *made_.front().renderer;
}

}  // namespace gazeloop::study
