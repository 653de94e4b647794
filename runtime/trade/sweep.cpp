#include "runtime/trade/sweep.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "runtime/methods/registry.h"
#include "runtime/render/off_screen.h"
#include "runtime/render/scene_options.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/scene_file.h"
#include "runtime/trade/point_picture.h"
#include "runtime/trade/settings_of_point.h"
#include "runtime/trade/time_left.h"
#include "sim/baked_light_field.h"

namespace gazeloop::trade {
namespace {

std::uint64_t hash_of(const render::LinearPicture& picture) {
    return XXH3_64bits(picture.pixels.data(), picture.pixels.size() * sizeof(glm::vec3));
}

/// One case's points.
class CaseSweep {
  public:
    CaseSweep(const vulkan::Context& context, const SweepQuestion& question, std::size_t at_case,
              const SweptValues& values, settings::Settings& settings, const SweepHooks& hooks,
              SweepRecord& record)
        : context_(context),
          question_(question),
          at_case_(at_case),
          case_(question.cases[at_case]),
          values_(values),
          settings_(settings),
          hooks_(hooks),
          record_(record) {
        for (std::size_t point = 0; point < record.points.size(); ++point) {
            if (question.shard.has(point)) {
                contenders_.emplace_back().point = point;
            }
        }
        for (const JudgedPoint& judged : record.judged) {
            if (judged.of_case == at_case) {
                const auto found = std::ranges::find(contenders_, judged.point, &Contender::point);
                if (found != contenders_.end()) {
                    found->known = true;
                    found->failed = !judged.error.empty();
                }
                if (judged.reference_hash) {
                    hash_before_ = judged.reference_hash;
                }
            }
        }
        for (const TimedTurn& turn : record.turns) {
            if (turn.of_case == at_case) {
                timed_.emplace(turn.round, turn.frame);
            }
        }
    }

    Expected<void> run() {
        const std::size_t known = count_known();
        const bool all_timed = timed_.size() == std::size_t{question_.rounds} * frames();
        if (known == contenders_.size() && all_timed && !may_change()) {
            return {};
        }
        if (known < contenders_.size()) {
            if (auto judged = judge_all(); !judged) {
                return judged;
            }
        } else if (hash_before_) {
            if (auto same = render_reference(1); !same) {
                return same;
            }
        }
        reference_.clear();
        return all_timed ? Expected<void>{} : time_all();
    }

    /// Says of every point that is not judged why its case cannot be rendered.
    Expected<void> fail(const std::string& why) {
        for (const Contender& contender : contenders_) {
            if (contender.known) {
                continue;
            }
            const JudgedPoint judged{.of_case = at_case_, .point = contender.point, .error = why};
            if (auto kept = hooks_.judged(judged); !kept) {
                return kept;
            }
            record_.judged.push_back(judged);
        }
        say(why);
        return {};
    }

  private:
    struct Contender {
        std::size_t point = 0;
        bool known = false;                   ///< judged
        bool failed = false;                  ///< and why is in its record
        const scene::Scene* scene = nullptr;  ///< of the renderer
        std::unique_ptr<render::OffScreen> renderer;
    };

    /// Whether the scene may be another one by the same name.
    [[nodiscard]] bool may_change() const {
        return scene::is_scene_file(case_.scene) || scene::is_light_field_file(case_.scene);
    }
    [[nodiscard]] std::size_t frames() const { return case_.directions.size(); }
    [[nodiscard]] std::size_t count_known() const {
        return static_cast<std::size_t>(std::ranges::count(contenders_, true, &Contender::known));
    }
    [[nodiscard]] const SweepPoint& point_of(const Contender& contender) const {
        return record_.points[contender.point];
    }

    [[nodiscard]] Expected<void> stop_if_interrupted() const {
        if (hooks_.interrupted()) {
            return std::unexpected(Error{ErrorKind::Interrupted, "the sweep was interrupted"});
        }
        return {};
    }

    void say(const std::string& text) const {
        hooks_.progress(question_.cases.size() > 1
                            ? fmt::format("case {} of {} ({}, {}): {}", at_case_ + 1,
                                          question_.cases.size(), case_.scene, case_.gaze, text)
                            : text);
    }

    [[nodiscard]] render::FrameView view(std::size_t frame) const {
        render::FrameView view{.index = frame,
                               .scene_time_s = static_cast<double>(frame) * question_.frame_seconds,
                               .views = question_.views,
                               .targets = {}};
        if (!case_.heads.empty()) {
            for (gaze::EyeView& one : view.views) {
                one.pose = gaze::compose(case_.heads[frame], one.pose);
            }
        }
        return view;
    }

    [[nodiscard]] gaze::FrameFovea fovea(std::size_t frame) const {
        gaze::FrameFovea foveae;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            foveae.eyes[e].direction = case_.directions[frame][e];
            foveae.eyes[e].position = gaze::project(foveae.eyes[e].direction, question_.views[e]);
            foveae.eyes[e].state = gaze::FoveaState::Tracking;
        }
        return foveae;
    }

    /// The case's scene, made once for each way to make it.
    [[nodiscard]] scene::Scene& scene(const scene::SceneOptions& options) {
        for (const auto& [made_with, scene] : scenes_) {
            if (made_with == options) {
                return *scene;
            }
        }
        scenes_.emplace_back(options, sim::make_scene(context_, case_.scene, options,
                                                      [&] { return !hooks_.interrupted(); }));
        return *scenes_.back().second;
    }

    [[nodiscard]] std::unique_ptr<render::OffScreen> renderer(scene::Scene& scene,
                                                              const render::MakePasses& passes,
                                                              render::RendererConfig config) const {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            config.extents[e] =
                vk::Extent2D(question_.views[e].width_px, question_.views[e].height_px);
        }
        return std::make_unique<render::OffScreen>(context_, scene, passes, config);
    }

    [[nodiscard]] gaze::Eye eye() const { return question_.comparison.eye; }

    /// The first `count` frames of the reference.
    /// Errors: also BadInput where its first frame is not what it was when the sweep began.
    Expected<void> render_reference(std::size_t count) {
        const gaze::EyeView& view_of_eye = question_.views[gaze::index(eye())];
        const std::uint64_t bytes =
            std::uint64_t{view_of_eye.width_px} * view_of_eye.height_px * sizeof(glm::vec3) * count;
        if (bytes > kMostReferenceBytes) {
            return std::unexpected(Error{
                ErrorKind::Usage,
                fmt::format("the reference's {} frames would take {} MiB of memory, over {}: fewer "
                            "--frames, or smaller pictures (--set render.scale=0.5)",
                            count, bytes >> 20U, kMostReferenceBytes >> 20U)});
        }
        const auto passes = methods::find_method("full")->passes(values_.methods, settings_);
        if (!passes) {
            return std::unexpected(passes.error());
        }
        render::RendererConfig config;
        config.samples = question_.reference_samples;
        config.camera = render::camera_of(values_.render);
        const auto full = renderer(scene({.light_field = values_.light_field}), *passes, config);
        for (std::size_t frame = 0; frame < count; ++frame) {
            if (auto stopped = stop_if_interrupted(); !stopped) {
                return stopped;
            }
            full->render(view(frame), fovea(frame));
            reference_.push_back(full->linear_picture(eye()));
            if (frame == 0 && hash_before_ && *hash_before_ != hash_of(reference_.front())) {
                return std::unexpected(Error{
                    ErrorKind::BadInput,
                    fmt::format("'{}' is not what it was when this sweep began: its files or the "
                                "driver have changed, so that figures from before do not "
                                "compare; name another file for --resume",
                                case_.scene)});
            }
        }
        if (count == frames()) {
            say(fmt::format("{} frames of the reference rendered", count));
        }
        return {};
    }

    /// Of the reference's frames that are judged.
    [[nodiscard]] Expected<quality::ContrastShares> reference_shares() const {
        const quality::RowWork work(question_.comparison.contrast.threads);
        const auto count = static_cast<double>(frames() - question_.first_judged);
        quality::ContrastShares mean;
        for (std::size_t frame = question_.first_judged; frame < frames(); ++frame) {
            const auto shares = quality::contrast_shares(
                reference_[frame], question_.comparison.view,
                case_.directions[frame][gaze::index(eye())], question_.comparison.line,
                question_.comparison.contrast.light, work);
            if (!shares) {
                return shares;
            }
            mean.kept += shares->kept / count;
            mean.between += shares->between / count;
            mean.beyond += shares->beyond / count;
            mean.contrast += shares->contrast / count;
        }
        return mean;
    }

    Expected<void> judge_all() {
        if (auto rendered = render_reference(frames()); !rendered) {
            return rendered;
        }
        const auto shares = reference_shares();
        if (!shares) {
            return std::unexpected(shares.error());
        }
        quality::ComparisonQuestion asked = question_.comparison;
        asked.with_maps = question_.with_pictures;
        auto comparison = quality::Comparison::create(asked);
        if (!comparison) {
            return std::unexpected(comparison.error());
        }
        TimeLeft left(contenders_.size() - count_known());
        for (Contender& contender : contenders_) {
            if (contender.known) {
                continue;
            }
            if (auto stopped = stop_if_interrupted(); !stopped) {
                return stopped;
            }
            auto judged = judge(contender, *comparison);
            if (!judged) {
                if (judged.error().kind == ErrorKind::Interrupted) {
                    return std::unexpected(judged.error());
                }
                contender.renderer.reset();
                contender.failed = true;
                judged = JudgedPoint{
                    .of_case = at_case_, .point = contender.point, .error = judged.error().message};
            }
            if (contender.point == 0) {
                judged->shares = *shares;
                judged->reference_hash = hash_of(reference_.front());
            }
            if (auto kept = hooks_.judged(*judged); !kept) {
                return kept;
            }
            contender.known = true;
            left.done_one();
            say(fmt::format("{} of {} points compared{}: {} {}{}", count_known(),
                            contenders_.size(), left.text(), point_of(contender).method,
                            point_of(contender).settings_text(),
                            judged->error.empty() ? "" : fmt::format(": {}", judged->error)));
            record_.judged.push_back(std::move(*judged));
        }
        return {};
    }

    Expected<void> make_renderer(Contender& contender) {
        const methods::Method& method = *methods::find_method(point_of(contender).method);
        SettingsOfPoint of_point(settings_);
        if (auto set = of_point.set(point_of(contender)); !set) {
            return set;
        }
        if (method.check_picture != nullptr) {
            for (const gaze::EyeView& one : question_.views) {
                if (auto checked = method.check_picture(values_.methods, settings_,
                                                        {one.width_px, one.height_px});
                    !checked) {
                    return checked;
                }
            }
        }
        const auto passes = method.passes(values_.methods, settings_);
        if (!passes) {
            return std::unexpected(passes.error());
        }
        render::RendererConfig config;
        config.samples = question_.samples;
        config.camera = render::camera_of(values_.render);
        config.lp_gaussian = render::lp_gaussian_of(values_.render);
        config.antialiasing = render::antialiasing_of(values_.render);
        scene::Scene& shown = scene(render::scene_options(values_.render, values_.light_field));
        contender.scene = &shown;
        contender.renderer = renderer(shown, *passes, config);
        return {};
    }

    /// Makes the point's renderer and compares its frames.
    Expected<JudgedPoint> judge(Contender& contender, quality::Comparison& comparison) {
        JudgedPoint judged{.of_case = at_case_, .point = contender.point};
        comparison.forget();
        quality::QualityTotals totals;
        try {
            if (auto made = make_renderer(contender); !made) {
                return std::unexpected(made.error());
            }
            double cells = 0.0;
            for (std::size_t frame = 0; frame < frames(); ++frame) {
                if (auto stopped = stop_if_interrupted(); !stopped) {
                    return std::unexpected(stopped.error());
                }
                const auto rendered = contender.renderer->render(view(frame), fovea(frame));
                const render::LinearPicture picture = contender.renderer->linear_picture(eye());
                const auto quality = comparison.compare(
                    reference_[frame], picture, case_.directions[frame][gaze::index(eye())]);
                if (!quality) {
                    return std::unexpected(quality.error());
                }
                if (hooks_.compared) {
                    hooks_.compared(
                        {at_case_, contender.point, frame, rendered.counts.shaded(), *quality});
                }
                if (frame >= question_.first_judged) {
                    cells += static_cast<double>(rendered.counts.shaded());
                    totals.add(*quality);
                }
                if (question_.with_pictures && frame + 1 == frames()) {
                    judged.picture = small_picture(picture);
                    judged.heat_map = small_heat_map(*quality);
                }
            }
            judged.cells = cells / static_cast<double>(frames() - question_.first_judged);
        } catch (const SetupError& error) {
            return std::unexpected(Error{error.kind(), error.what()});
        }
        const frame::PassList& passes = contender.renderer->renderer().passes();
        for (std::size_t pass = 0; pass < passes.size(); ++pass) {
            judged.passes.emplace_back(passes[pass]);
        }
        judged.figures = totals.figures();
        return judged;
    }

    /// The points that were judged before this sweep went on: all have rendered the same frames
    /// before they are timed.
    Expected<void> warm_up_known() {
        for (Contender& contender : contenders_) {
            if (contender.renderer || contender.failed) {
                continue;
            }
            if (auto made = make_renderer(contender); !made) {
                return made;
            }
            for (std::size_t frame = 0; frame < frames(); ++frame) {
                if (auto stopped = stop_if_interrupted(); !stopped) {
                    return stopped;
                }
                contender.renderer->render(view(frame), fovea(frame));
            }
        }
        return {};
    }

    Expected<void> time_all() {
        if (auto warm = warm_up_known(); !warm) {
            return warm;
        }
        const std::size_t all = std::size_t{question_.rounds} * frames();
        TimeLeft left(all - timed_.size());
        for (unsigned round = 0; round < question_.rounds; ++round) {
            const auto first = timed_.lower_bound({round, 0});
            const bool any = first != timed_.end() && first->first == round;
            if (any && timed_.contains({round, frames() - 1})) {
                continue;
            }
            for (std::size_t frame = 0; frame < frames(); ++frame) {
                // What was timed already is rendered again for the histories alone.
                auto turn = render_turn(round, frame);
                if (!turn) {
                    return std::unexpected(turn.error());
                }
                if (timed_.contains({round, frame})) {
                    continue;
                }
                if (auto kept = hooks_.timed(*turn); !kept) {
                    return kept;
                }
                timed_.emplace(round, frame);
                record_.turns.push_back(std::move(*turn));
                left.done_one();
            }
            say(fmt::format("{} of {} rounds timed{}", round + 1, question_.rounds, left.text()));
        }
        return {};
    }

    [[nodiscard]] std::optional<double> joules() const {
        return hooks_.joules ? hooks_.joules() : std::nullopt;
    }

    [[nodiscard]] static std::uint64_t views_waited_for(const scene::Scene& scene) {
        const scene::ViewWaits waits = scene.view_waits();
        return waits.views + waits.late_views;
    }

    /// One frame by all points that work, to and fro, so that none always comes after the same one:
    /// whoever follows full resolution finds its caches full of that.
    Expected<TimedTurn> render_turn(unsigned round, std::size_t frame) {
        TimedTurn turn{.of_case = at_case_, .round = round, .frame = frame};
        for (std::size_t i = 0; i < contenders_.size(); ++i) {
            const bool fro = (round + frame) % 2 == 1;
            const Contender& contender = contenders_[fro ? contenders_.size() - 1 - i : i];
            if (auto stopped = stop_if_interrupted(); !stopped) {
                return std::unexpected(stopped.error());
            }
            if (!contender.renderer) {
                continue;
            }
            const std::uint64_t waited_before = views_waited_for(*contender.scene);
            const std::optional<double> before = joules();
            const frame::FrameGpuRecord gpu =
                contender.renderer->render(view(frame), fovea(frame)).gpu;
            PointTime time{.point = contender.point};
            if (const std::optional<double> after = joules(); before && after) {
                time.energy_j = *after - *before;
            }
            time.waited_views = views_waited_for(*contender.scene) - waited_before;
            for (std::size_t pass = 0; pass < contender.renderer->renderer().passes().size();
                 ++pass) {
                time.pass_ms.push_back(1e-6 * static_cast<double>(gpu.passes[pass].value_or(0)));
            }
            turn.times.push_back(std::move(time));
        }
        return turn;
    }

    const vulkan::Context& context_;
    const SweepQuestion& question_;
    std::size_t at_case_;
    const CaseQuestion& case_;
    const SweptValues& values_;
    settings::Settings& settings_;
    const SweepHooks& hooks_;
    SweepRecord& record_;
    /// Outlive the renderers.
    std::vector<std::pair<scene::SceneOptions, std::unique_ptr<scene::Scene>>> scenes_;
    std::vector<Contender> contenders_;
    std::set<std::pair<unsigned, std::size_t>> timed_;  ///< round, frame
    std::vector<render::LinearPicture> reference_;
    std::optional<std::uint64_t> hash_before_;  ///< of its first frame, when the sweep began
};

}  // namespace

Expected<void> sweep(const vulkan::Context& context, const SweepQuestion& question,
                     const SweptValues& values, settings::Settings& settings,
                     const SweepHooks& hooks, SweepRecord& record) {
    for (std::size_t at_case = 0; at_case < question.cases.size(); ++at_case) {
        CaseSweep one(context, question, at_case, values, settings, hooks, record);
        try {
            if (auto done = one.run(); !done) {
                return done;
            }
        } catch (const SetupError& error) {
            // Of several scenes one that cannot be shown takes nothing from the others.
            if (error.kind() != ErrorKind::BadInput || question.cases.size() == 1) {
                throw;
            }
            if (auto failed = one.fail(error.what()); !failed) {
                return failed;
            }
        }
    }
    return {};
}

}  // namespace gazeloop::trade
