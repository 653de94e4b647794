#include "runtime/study/replayed_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>

#include "runtime/study/drawn_gaze.h"

namespace gazeloop::study {

Expected<std::unique_ptr<ReplayedStudy>> ReplayedStudy::create(
    const std::vector<session::TrialRow>& rows) {
    auto study = std::make_unique<ReplayedStudy>();
    for (const session::TrialRow& row : rows) {
        Shown& shown = study->shown_.emplace_back(row.first_frame, row.follows_gaze,
                                                  Stimulus{.method = row.method});
        std::istringstream words(row.settings);
        for (std::string word; words >> word;) {
            const std::size_t equals = word.find('=');
            if (equals == std::string::npos) {
                return std::unexpected(Error{
                    ErrorKind::BadInput,
                    fmt::format("trial: frame {}: '{}' is no KEY=VALUE: the recording is damaged",
                                row.first_frame, word)});
            }
            shown.stimulus.settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
        }
    }
    return study;
}

std::vector<Stimulus> ReplayedStudy::samples() const {
    std::vector<Stimulus> samples;
    for (const Shown& shown : shown_) {
        const auto alike = [&shown](const Stimulus& one) {
            return one.method == shown.stimulus.method && one.scene() == shown.stimulus.scene();
        };
        if (!shown.stimulus.method.empty() && std::ranges::none_of(samples, alike)) {
            samples.push_back(shown.stimulus);
        }
    }
    return samples;
}

render::FrameRenderer* ReplayedStudy::choose(const render::FrameToChoose& frame) {
    while (now_ + 1 < shown_.size() && shown_[now_ + 1].first_frame <= frame.index) {
        ++now_;
    }
    const Shown& shown = shown_[now_];
    return shown.stimulus.method.empty() || !frame.should_render ? nullptr
                                                                 : &stimuli_->of(shown.stimulus);
}

gaze::FrameFovea ReplayedStudy::drawn(const gaze::FrameFovea& latched,
                                      const gaze::StereoView& views) const {
    return shown_[now_].follows_gaze ? latched : straight_ahead(latched, views);
}

}  // namespace gazeloop::study
