#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/render/frame_chooser.h"
#include "runtime/render/frame_renderer.h"
#include "runtime/render/run_lists.h"

namespace gazeloop::study {

/// What a picture of a study is drawn by.
struct Stimulus {
    std::string method;
    /// Others than those in force: key, text.
    std::vector<std::pair<std::string, std::string>> settings{};

    /// KEY=VALUE, with blanks between.
    [[nodiscard]] std::string settings_text() const;
    /// The scene that it draws, if it is another than the run's; else empty.
    [[nodiscard]] std::string_view scene() const;
    friend bool operator==(const Stimulus&, const Stimulus&) = default;
};

/// Throws SetupError for a stimulus that cannot be drawn.
using MakeStimulus = std::function<std::unique_ptr<render::FrameRenderer>(const Stimulus&)>;

/// The renderers of a study's stimuli. Made when they are first asked for, which takes long, so ask
/// while the display is black; the least recently used ones go, because their pictures fill memory.
class Stimuli {
  public:
    /// `samples`: one of each method in each scene; their passes and grids are the run's. Throws
    /// what `make` throws, and SetupError (Usage) if they are more than a session has columns for.
    Stimuli(MakeStimulus make, const std::vector<Stimulus>& samples);

    /// Stays until kMost others have been asked for. Throws what `make` throws, and SetupError
    /// (Usage) for a pass or a grid that no sample has.
    [[nodiscard]] render::FrameRenderer& of(const Stimulus& stimulus);

    /// What the renderers draw, as the run's records have it.
    [[nodiscard]] const render::RunLists& lists() const { return lists_; }

    /// The one that is drawn by, the two of the next trial, and those of the last one.
    static constexpr std::size_t kMost = 5;

  private:
    struct Made {
        Stimulus stimulus;
        std::unique_ptr<render::FrameRenderer> renderer;
    };

    MakeStimulus make_;
    std::list<Made> made_;  ///< the most recently used first
    render::RunLists lists_{"the study's methods"};
};

}  // namespace gazeloop::study
