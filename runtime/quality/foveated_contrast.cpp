#include "runtime/quality/foveated_contrast.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/quality/compared_pictures.h"
#include "runtime/quality/contrast_levels.h"
#include "runtime/quality/fast_exponent.h"
#include "runtime/quality/pyramid.h"
#include "runtime/quality/row_work.h"
#include "runtime/quality/temporal_filter.h"

namespace gazeloop::quality {
namespace {

/// What contrasts are over is at least this, cd/m2: the least luminance that stelaCSF knows.
constexpr float kLeastLuminance = 1e-3F;

/// What a difference keeps beside what is there in both pictures, in thresholds:
/// (1 + mask^2.8)^(-1/4).
float kept_beside(float mask) {
    constexpr float kSlope = 2.8F;
    return exp2_of(-0.25F * log2_of(1.0F + exp2_of(kSlope * log2_of(mask))));
}

/// The two pictures of a comparison.
template <typename T>
using Both = std::array<T, 2>;

using MechanismPlanes = std::array<Plane, kMechanisms>;

Expected<void> check_light(const DisplayLight& light) {
    if (!(light.peak_cd_m2 >= DisplayLight::kMinPeak &&
          light.peak_cd_m2 <= DisplayLight::kMaxPeak)) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("the display's peak luminance, {} cd/m2, must lie in [{}, {}]",
                              light.peak_cd_m2, DisplayLight::kMinPeak, DisplayLight::kMaxPeak)});
    }
    if (!(light.black_cd_m2 >= 0.0 && light.black_cd_m2 <= light.peak_cd_m2)) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("the display's black, {} cd/m2, must lie between 0 and its peak, {}",
                              light.black_cd_m2, light.peak_cd_m2)});
    }
    return {};
}

/// stelaCSF's sustained response is one half at 6.05 Hz; castleCSF's for colour at these.
constexpr std::array kHalfResponse_hz{6.05, 8.19, 5.17};

}  // namespace

class FoveatedContrast::Work {
  public:
    Work(const gaze::EyeView& view, gaze::Eye eye, const ContrastOptions& options)
        : view_(view),
          options_(options),
          rows_(options.threads),
          levels_(view, eye, rows_),
          tables_{SensitivityTable(Mechanism::Sustained), SensitivityTable(Mechanism::RedGreen),
                  SensitivityTable(Mechanism::YellowViolet),
                  SensitivityTable(Mechanism::Transient)},
          memory_(levels_.levels().size()) {}

    Expected<ContrastDifference> compare(const render::LinearPicture& reference,
                                         const render::LinearPicture& test, const glm::dvec3& gaze,
                                         std::optional<double> seconds, bool with_map) {
        if (auto checked = check_pictures(reference, test, view_); !checked) {
            return std::unexpected(checked.error());
        }
        if (auto looked = look(gaze); !looked) {
            return std::unexpected(looked.error());
        }
        const Both<const render::LinearPicture*> pictures{&reference, &test};
        for (std::size_t p = 0; p < 2; ++p) {
            MechanismPlanes& base = memory_.front().planes[p];
            const std::span<Plane, kOpponentChannels> channels{base.data(), kOpponentChannels};
            opponent_planes(*pictures[p], options_.light, rows_, channels);
            if (seconds) {
                for (std::size_t c = 0; c < kOpponentChannels; ++c) {
                    filters_[p][c].show(channels[c], *seconds, rows_);
                    channels[c] = filters_[p][c].sustained();
                }
                filters_[p][kLuminance].transient(
                    rows_, base[static_cast<std::size_t>(Mechanism::Transient)]);
            }
        }
        return difference(seconds ? kMechanisms : kStillMechanisms, with_map);
    }

    void forget() {
        for (auto& filters : filters_) {
            for (TemporalFilter& filter : filters) {
                filter.forget();
            }
        }
    }

  private:
    Expected<void> look(const glm::dvec3& gaze) {
        if (gaze_ && *gaze_ == gaze) {
            return {};
        }
        const auto field = foveation::GazeField::create(view_, gaze);
        if (!field) {
            return std::unexpected(field.error());
        }
        levels_.look(*field, rows_);
        gaze_ = gaze;
        return {};
    }

    /// What a level of the pyramid takes; every comparison uses it again.
    struct LevelMemory {
        Both<MechanismPlanes> planes;
        Both<Plane> contrasts;  ///< of the mechanism at hand
        Plane luminance;        ///< what the band rests on
        Plane log2_luminance;
        Plane squares;  ///< of thresholds, all mechanisms
    };

    /// Of what the finest level's planes hold.
    ContrastDifference difference(std::size_t mechanisms, bool with_map) {
        const std::size_t bands = levels_.bands();
        ContrastDifference result;
        for (std::size_t at = 0; at <= bands; ++at) {
            const ContrastLevels::Level& level = levels_.levels()[at];
            LevelMemory& memory = memory_[at];
            memory.squares.resize(level.width, level.height);
            std::ranges::fill(memory.squares.values, 0.0F);
            const bool rest = at == bands;
            for (std::size_t m = 0; m < mechanisms; ++m) {
                LevelMemory* const coarser = rest ? nullptr : &memory_[at + 1];
                for (std::size_t p = 0; p < 2 && !rest; ++p) {
                    reduce(memory.planes[p][m], rows_, coarser->planes[p][m]);
                }
                // Luminance comes first: all other contrasts are over it.
                band_contrasts(level, m, coarser, memory);
                result.mechanisms[m] += detect(level, m, !rest, memory);
            }
        }
        double sum = 0.0;
        for (double& mechanism : result.mechanisms) {
            sum += mechanism;
            mechanism = std::sqrt(mechanism);
        }
        result.value = std::sqrt(sum);
        if (with_map) {
            result.map = collapsed();
        }
        return result;
    }

    /// The band's contrasts in both pictures; with luminance also what it rests on. `coarser`:
    /// null for the rest, under which nothing lies.
    void band_contrasts(const ContrastLevels::Level& level, std::size_t mechanism,
                        const LevelMemory* coarser, LevelMemory& memory) {
        for (Plane& plane : memory.contrasts) {
            plane.resize(level.width, level.height);
        }
        memory.luminance.resize(level.width, level.height);
        memory.log2_luminance.resize(level.width, level.height);
        const auto over_gain = static_cast<float>(1.0 / level.band_gain);
        rows_.over(level.height, [&](std::uint32_t from, std::uint32_t to) {
            std::vector<float> scratch(halved(level.width));
            Both<std::vector<float>> under{std::vector<float>(level.width),
                                           std::vector<float>(level.width)};
            for (std::uint32_t y = from; y < to; ++y) {
                for (std::size_t p = 0; p < 2; ++p) {
                    if (coarser == nullptr) {
                        std::copy_n(memory.planes[p][mechanism].row(y), level.width,
                                    under[p].begin());
                    } else {
                        expand_row(coarser->planes[p][mechanism], y, level.width, scratch.data(),
                                   under[p].data());
                    }
                }
                float* const luminance = memory.luminance.row(y);
                if (mechanism == kLuminance) {
                    float* const logarithm = memory.log2_luminance.row(y);
                    for (std::uint32_t x = 0; x < level.width; ++x) {
                        luminance[x] =
                            std::max(0.5F * (under[0][x] + under[1][x]), kLeastLuminance);
                        logarithm[x] = log2_of(luminance[x]);
                    }
                }
                for (std::size_t p = 0; p < 2; ++p) {
                    const float* const whole = memory.planes[p][mechanism].row(y);
                    float* const contrast = memory.contrasts[p].row(y);
                    for (std::uint32_t x = 0; x < level.width; ++x) {
                        const float band = coarser == nullptr ? whole[x] : whole[x] - under[p][x];
                        contrast[x] = band * over_gain / luminance[x];
                    }
                }
            }
        });
    }

    /// Adds the squares of what is seen of the contrasts' difference; gives their mean over solid
    /// angle.
    double detect(const ContrastLevels::Level& level, std::size_t mechanism, bool masked,
                  LevelMemory& memory) {
        const SensitivityTable& table = tables_[mechanism];
        const Plane& decay_plane = level.decay[mechanism < kStillMechanisms ? mechanism : 0];
        std::vector<double> row_sums(level.height);
        rows_.over(level.height, [&](std::uint32_t from, std::uint32_t to) {
            // What both have, with a pixel beyond each end.
            std::vector<float> common(std::size_t{level.width} + 2);
            std::vector<float> seen_row(level.width);
            float* const seen = seen_row.data();
            const auto add_row = [&](std::uint32_t y, float weight) {
                const float* const a = memory.contrasts[0].row(y);
                const float* const b = memory.contrasts[1].row(y);
                for (std::uint32_t x = 0; x < level.width; ++x) {
                    common[x + 1] += weight * std::min(std::abs(a[x]), std::abs(b[x]));
                }
            };
            for (std::uint32_t y = from; y < to; ++y) {
                if (masked) {
                    std::ranges::fill(common, 0.0F);
                    add_row(y == 0 ? 0 : y - 1, 0.25F);
                    add_row(y, 0.5F);
                    add_row(std::min(y + 1, level.height - 1), 0.25F);
                    common.front() = common[1];
                    common.back() = common[level.width];
                }
                const float* const a = memory.contrasts[0].row(y);
                const float* const b = memory.contrasts[1].row(y);
                const float* const luminance = memory.log2_luminance.row(y);
                const float* const cpd = level.log2_cpd.row(y);
                const float* const decay = decay_plane.row(y);
                const float* const weight = level.weight.row(y);
                float* const square = memory.squares.row(y);
                for (std::uint32_t x = 0; x < level.width; ++x) {
                    seen[x] = table.log2_at(cpd[x], luminance[x]) - decay[x];
                }
                const float* const beside = common.data();
                for (std::uint32_t x = 0; x < level.width; ++x) {
                    const float sensitivity = exp2_of(seen[x]);
                    const float mask = 0.5F * beside[x + 1] + 0.25F * (beside[x] + beside[x + 2]);
                    const float thresholds =
                        sensitivity * std::abs(a[x] - b[x]) * kept_beside(sensitivity * mask);
                    seen[x] = thresholds * thresholds;
                    square[x] += seen[x];
                }
                double sum = 0.0;
                for (std::uint32_t x = 0; x < level.width; ++x) {
                    sum += static_cast<double>(weight[x]) * static_cast<double>(seen[x]);
                }
                row_sums[y] = sum;
            }
        });
        return std::accumulate(row_sums.begin(), row_sums.end(), 0.0);
    }

    /// The roots of the squares of all levels, in the picture's size; uses them up.
    Plane collapsed() {
        for (std::size_t at = memory_.size() - 1; at > 0; --at) {
            const Plane& coarser = memory_[at].squares;
            Plane& finer = memory_[at - 1].squares;
            rows_.over(finer.height, [&](std::uint32_t from, std::uint32_t to) {
                std::vector<float> scratch(coarser.width);
                std::vector<float> row(finer.width);
                for (std::uint32_t y = from; y < to; ++y) {
                    expand_row(coarser, y, finer.width, scratch.data(), row.data());
                    float* const out = finer.row(y);
                    for (std::uint32_t x = 0; x < finer.width; ++x) {
                        out[x] += row[x];
                    }
                }
            });
        }
        Plane map = memory_.front().squares;
        for (float& value : map.values) {
            value = std::sqrt(value);
        }
        return map;
    }

    static std::array<TemporalFilter, kOpponentChannels> make_filters() {
        return {TemporalFilter(TemporalResponse(kHalfResponse_hz[0])),
                TemporalFilter(TemporalResponse(kHalfResponse_hz[1])),
                TemporalFilter(TemporalResponse(kHalfResponse_hz[2]))};
    }

    gaze::EyeView view_;
    ContrastOptions options_;
    RowWork rows_;
    ContrastLevels levels_;
    std::array<SensitivityTable, kMechanisms> tables_;
    std::optional<glm::dvec3> gaze_;
    Both<std::array<TemporalFilter, kOpponentChannels>> filters_{make_filters(), make_filters()};
    std::vector<LevelMemory> memory_;  ///< by level
};

FoveatedContrast::FoveatedContrast(std::unique_ptr<Work> work) : work_(std::move(work)) {}
FoveatedContrast::FoveatedContrast(FoveatedContrast&&) noexcept = default;
FoveatedContrast& FoveatedContrast::operator=(FoveatedContrast&&) noexcept = default;
FoveatedContrast::~FoveatedContrast() = default;

Expected<FoveatedContrast> FoveatedContrast::create(const gaze::EyeView& view, gaze::Eye eye,
                                                    const ContrastOptions& options) {
    if (auto checked = check_light(options.light); !checked) {
        return std::unexpected(checked.error());
    }
    if (auto field = foveation::GazeField::create(view, {0.0, 0.0, -1.0}); !field) {
        return std::unexpected(field.error());
    }
    return FoveatedContrast(std::make_unique<Work>(view, eye, options));
}

Expected<ContrastDifference> FoveatedContrast::still(const render::LinearPicture& reference,
                                                     const render::LinearPicture& test,
                                                     const glm::dvec3& gaze, bool with_map) {
    return work_->compare(reference, test, gaze, std::nullopt, with_map);
}

Expected<ContrastDifference> FoveatedContrast::next(const render::LinearPicture& reference,
                                                    const render::LinearPicture& test,
                                                    const glm::dvec3& gaze, double seconds,
                                                    bool with_map) {
    if (!(seconds > 0.0 && seconds <= kMaxFrameSeconds)) {  // true for NaN
        return std::unexpected(
            Error{ErrorKind::Usage, fmt::format("a frame that is shown for {} s: must lie in "
                                                "(0, {}] s",
                                                seconds, kMaxFrameSeconds)});
    }
    return work_->compare(reference, test, gaze, seconds, with_map);
}

void FoveatedContrast::forget() { work_->forget(); }

}  // namespace gazeloop::quality
