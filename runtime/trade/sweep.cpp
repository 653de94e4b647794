#include "runtime/trade/sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include "runtime/foveation/eye/fewest_samples.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/methods/registry.h"
#include "runtime/render/off_screen.h"
#include "runtime/scene/scenes.h"

namespace gazeloop::trade {
namespace {

/// The points' settings while they are made, and those before in the end.
class SettingsOfPoint {
  public:
    explicit SettingsOfPoint(settings::Settings& settings) : settings_(settings) {}
    SettingsOfPoint(const SettingsOfPoint&) = delete;
    SettingsOfPoint& operator=(const SettingsOfPoint&) = delete;
    ~SettingsOfPoint() {
        for (auto kept = before_.rbegin(); kept != before_.rend(); ++kept) {
            (void)settings_.set(kept->key, kept->text, kept->origin);
        }
    }

    Expected<void> set(const SweepPoint& point) {
        for (const auto& [key, text] : point.settings) {
            for (const settings::SettingRow& row : settings_.rows()) {
                if (row.key == key) {
                    before_.push_back({key, settings::text_of(row), settings_.origin(key)});
                }
            }
            if (auto done = settings_.set(key, text, "trade"); !done) {
                return done;
            }
        }
        return {};
    }

  private:
    struct Kept {
        std::string key;
        std::string text;
        std::string origin;
    };
    settings::Settings& settings_;
    std::vector<Kept> before_;
};

/// What each pass took; 0 for one that did not run.
using PassMs = std::array<double, frame::kMostPasses>;

void add(PassMs& sums, const frame::FrameGpuRecord& gpu) {
    for (std::size_t pass = 0; pass < sums.size(); ++pass) {
        sums[pass] += 1e-6 * static_cast<double>(gpu.passes[pass].value_or(0));
    }
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

class Sweep {
  public:
    Sweep(const vulkan::Context& context, const SweepQuestion& question,
          const std::vector<SweepPoint>& points, const methods::MethodSettings& values,
          settings::Settings& settings, const SweepHooks& hooks)
        : context_(context),
          question_(question),
          values_(values),
          settings_(settings),
          hooks_(hooks),
          scene_(scene::make_scene(context, question.scene)) {
        contenders_.emplace_back().row.point.method = "full";
        for (const SweepPoint& point : points) {
            if (point.method != "full") {
                contenders_.emplace_back().row.point = point;
            }
        }
    }

    Expected<std::vector<SweepRow>> run() {
        if (auto rendered = render_reference(); !rendered) {
            return std::unexpected(rendered.error());
        }
        auto comparison = quality::Comparison::create(question_.comparison);
        if (!comparison) {
            return std::unexpected(comparison.error());
        }
        for (std::size_t at = 0; at < contenders_.size(); ++at) {
            Contender& contender = contenders_[at];
            if (auto stopped = stop_if_interrupted(); !stopped) {
                return std::unexpected(stopped.error());
            }
            if (auto judged = judge(contender, *comparison); !judged) {
                if (judged.error().kind == ErrorKind::Interrupted) {
                    return std::unexpected(judged.error());
                }
                contender.renderer.reset();
                contender.row.error = judged.error().message;
            }
            hooks_.progress(fmt::format(
                "{} of {} points compared: {} {}{}", at + 1, contenders_.size(),
                contender.row.point.method, contender.row.point.settings_text(),
                contender.row.error.empty() ? "" : fmt::format(": {}", contender.row.error)));
        }
        reference_.clear();
        for (unsigned round = 0; round < question_.rounds; ++round) {
            if (auto timed = time_round(); !timed) {
                return std::unexpected(timed.error());
            }
            hooks_.progress(fmt::format("{} of {} rounds timed", round + 1, question_.rounds));
        }
        const auto fewest = fewest_cells();
        if (!fewest) {
            return std::unexpected(fewest.error());
        }
        std::vector<SweepRow> rows;
        for (Contender& contender : contenders_) {
            finish(contender, *fewest);
            rows.push_back(std::move(contender.row));
        }
        mark_fronts(rows);
        return rows;
    }

  private:
    struct Contender {
        SweepRow row;
        std::unique_ptr<render::OffScreen> renderer;
        std::vector<double> round_ms{};  ///< means over the frames
        std::array<std::vector<double>, frame::kMostPasses> round_pass_ms{};
    };

    [[nodiscard]] Expected<void> stop_if_interrupted() const {
        if (hooks_.interrupted()) {
            return std::unexpected(Error{ErrorKind::Interrupted, "the sweep was interrupted"});
        }
        return {};
    }

    [[nodiscard]] render::FrameView view(std::size_t frame) const {
        return {.index = frame,
                .scene_time_s = static_cast<double>(frame) * question_.frame_seconds,
                .views = question_.views,
                .targets = {}};
    }

    [[nodiscard]] gaze::FrameFovea fovea(std::size_t frame) const {
        gaze::FrameFovea foveae;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            foveae.eyes[e].direction = question_.gaze[frame][e];
            foveae.eyes[e].position = gaze::project(foveae.eyes[e].direction, question_.views[e]);
            foveae.eyes[e].state = gaze::FoveaState::Tracking;
        }
        return foveae;
    }

    [[nodiscard]] std::unique_ptr<render::OffScreen> renderer(const render::MakePasses& passes,
                                                              std::uint32_t samples) const {
        render::RendererConfig config;
        config.samples = samples;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            config.extents[e] =
                vk::Extent2D(question_.views[e].width_px, question_.views[e].height_px);
        }
        return std::make_unique<render::OffScreen>(context_, *scene_, passes, config);
    }

    [[nodiscard]] gaze::Eye eye() const { return question_.comparison.eye; }

    Expected<void> render_reference() {
        const gaze::EyeView& view_of_eye = question_.views[gaze::index(eye())];
        const std::uint64_t bytes = std::uint64_t{view_of_eye.width_px} * view_of_eye.height_px *
                                    sizeof(glm::vec3) * question_.gaze.size();
        if (bytes > kMostReferenceBytes) {
            return std::unexpected(Error{
                ErrorKind::Usage,
                fmt::format("the reference's {} frames would take {} MiB of memory, over {}: fewer "
                            "--frames, or smaller pictures (--set render.scale=0.5)",
                            question_.gaze.size(), bytes >> 20U, kMostReferenceBytes >> 20U)});
        }
        const auto passes = methods::find_method("full")->passes(values_, settings_);
        if (!passes) {
            return std::unexpected(passes.error());
        }
        const auto full = renderer(*passes, question_.reference_samples);
        for (std::size_t frame = 0; frame < question_.gaze.size(); ++frame) {
            if (auto stopped = stop_if_interrupted(); !stopped) {
                return stopped;
            }
            full->render(view(frame), fovea(frame));
            reference_.push_back(full->linear_picture(eye()));
        }
        hooks_.progress(fmt::format("{} frames of the reference rendered", reference_.size()));
        return {};
    }

    /// Makes the point's renderer and compares its frames.
    Expected<void> judge(Contender& contender, quality::Comparison& comparison) {
        const methods::Method& method = *methods::find_method(contender.row.point.method);
        SettingsOfPoint of_point(settings_);
        if (auto set = of_point.set(contender.row.point); !set) {
            return set;
        }
        if (method.check_picture != nullptr) {
            for (const gaze::EyeView& one : question_.views) {
                if (auto checked =
                        method.check_picture(values_, settings_, {one.width_px, one.height_px});
                    !checked) {
                    return checked;
                }
            }
        }
        const auto passes = method.passes(values_, settings_);
        if (!passes) {
            return std::unexpected(passes.error());
        }
        comparison.forget();
        quality::QualityTotals totals;
        try {
            contender.renderer = renderer(*passes, question_.samples);
            double cells = 0.0;
            for (std::size_t frame = 0; frame < question_.gaze.size(); ++frame) {
                if (auto stopped = stop_if_interrupted(); !stopped) {
                    return stopped;
                }
                const auto rendered = contender.renderer->render(view(frame), fovea(frame));
                cells += static_cast<double>(rendered.counts.shaded());
                const auto quality =
                    comparison.compare(reference_[frame], contender.renderer->linear_picture(eye()),
                                       question_.gaze[frame][gaze::index(eye())]);
                if (!quality) {
                    return std::unexpected(quality.error());
                }
                totals.add(*quality);
            }
            contender.row.cells = cells / static_cast<double>(question_.gaze.size());
        } catch (const SetupError& error) {
            return std::unexpected(Error{error.kind(), error.what()});
        }
        contender.row.figures = totals.figures();
        return {};
    }

    /// All frames by all points that work, in turns.
    Expected<void> time_round() {
        std::vector<PassMs> sums_ms(contenders_.size());
        for (std::size_t frame = 0; frame < question_.gaze.size(); ++frame) {
            for (std::size_t at = 0; at < contenders_.size(); ++at) {
                if (auto stopped = stop_if_interrupted(); !stopped) {
                    return stopped;
                }
                if (contenders_[at].renderer) {
                    add(sums_ms[at],
                        contenders_[at].renderer->render(view(frame), fovea(frame)).gpu);
                }
            }
        }
        const auto frames = static_cast<double>(question_.gaze.size());
        for (std::size_t at = 0; at < contenders_.size(); ++at) {
            Contender& contender = contenders_[at];
            double total_ms = 0.0;
            for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
                contender.round_pass_ms[pass].push_back(sums_ms[at][pass] / frames);
                total_ms += sums_ms[at][pass] / frames;
            }
            contender.round_ms.push_back(total_ms);
        }
        return {};
    }

    /// By the comparison's line, both eyes, mean of the frames.
    [[nodiscard]] Expected<double> fewest_cells() const {
        const auto model = foveation::GuenterAcuity::create(question_.comparison.line);
        if (!model) {
            return std::unexpected(model.error());
        }
        double sum = 0.0;
        double of_frame = 0.0;
        for (std::size_t frame = 0; frame < question_.gaze.size(); ++frame) {
            if (frame > 0 && question_.gaze[frame] == question_.gaze[frame - 1]) {
                sum += of_frame;
                continue;
            }
            of_frame = 0.0;
            for (const gaze::Eye one : gaze::kEyes) {
                const std::size_t e = gaze::index(one);
                const auto field =
                    foveation::GazeField::create(question_.views[e], question_.gaze[frame][e]);
                if (!field) {
                    return std::unexpected(field.error());
                }
                of_frame += foveation::fewest_samples(*field, **model, one);
            }
            sum += of_frame;
        }
        return sum / static_cast<double>(question_.gaze.size());
    }

    void finish(Contender& contender, double fewest_cells) const {
        if (!contender.renderer) {
            return;
        }
        const Contender& full = contenders_.front();
        std::vector<double> ratios;
        for (std::size_t round = 0; round < contender.round_ms.size(); ++round) {
            ratios.push_back(full.round_ms[round] / contender.round_ms[round]);
        }
        SweepRow& row = contender.row;
        row.time = {median(contender.round_ms), std::ranges::min(contender.round_ms),
                    std::ranges::max(contender.round_ms)};
        row.speedup = median(ratios);
        row.fewer_cells = full_cells() / row.cells;
        row.cells_over_fewest = row.cells / fewest_cells;
        const frame::PassList& passes = contender.renderer->renderer().passes();
        for (std::size_t pass = 0; pass < passes.size(); ++pass) {
            row.pass_ms.emplace_back(passes[pass], median(contender.round_pass_ms[pass]));
        }
    }

    [[nodiscard]] double full_cells() const {
        double cells = 0.0;
        for (const gaze::EyeView& one : question_.views) {
            cells += static_cast<double>(one.width_px) * one.height_px;
        }
        return cells;
    }

    static void mark_fronts(std::vector<SweepRow>& rows) {
        const auto worse_by = [](const SweepRow& row) {
            const quality::QualityFigure& figure = row.figures.front();
            return figure.lower_is_better ? figure.mean : -figure.mean;
        };
        const auto mark = [&](const auto& cost, bool SweepRow::* front) {
            for (SweepRow& row : rows) {
                row.*front =
                    row.error.empty() && std::ranges::none_of(rows, [&](const SweepRow& other) {
                        return other.error.empty() && cost(other) <= cost(row) &&
                               worse_by(other) <= worse_by(row) &&
                               (cost(other) < cost(row) || worse_by(other) < worse_by(row));
                    });
            }
        };
        mark([](const SweepRow& row) { return row.cells; }, &SweepRow::on_cells_front);
        mark([](const SweepRow& row) { return row.time.median_ms; }, &SweepRow::on_time_front);
    }

    const vulkan::Context& context_;
    const SweepQuestion& question_;
    const methods::MethodSettings& values_;
    settings::Settings& settings_;
    const SweepHooks& hooks_;
    std::unique_ptr<scene::Scene> scene_;  ///< outlives the renderers
    std::vector<Contender> contenders_;
    std::vector<render::LinearPicture> reference_;
};

}  // namespace

Expected<std::vector<SweepRow>> sweep(const vulkan::Context& context, const SweepQuestion& question,
                                      const std::vector<SweepPoint>& points,
                                      const methods::MethodSettings& values,
                                      settings::Settings& settings, const SweepHooks& hooks) {
    return Sweep(context, question, points, values, settings, hooks).run();
}

}  // namespace gazeloop::trade
