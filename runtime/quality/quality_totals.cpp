#include "runtime/quality/quality_totals.h"

#include <fmt/core.h>

#include <cmath>

namespace gazeloop::quality {
namespace {

struct Kind {
    const char* key;
    const char* meaning;
    bool lower_is_better;
    bool decibel;
    std::optional<double> (*of)(const FrameQuality& frame);
};

template <std::size_t M>
std::optional<double> mechanism(const FrameQuality& frame) {
    return frame.contrast ? std::optional(frame.contrast->mechanisms[M]) : std::nullopt;
}

constexpr std::array kKinds{
    Kind{"contrast", "thresholds by stelaCSF and castleCSF, masked; 0: identical", true, false,
         [](const FrameQuality& frame) {
             return frame.contrast ? std::optional(frame.contrast->value) : std::nullopt;
         }},
    Kind{"contrast_achromatic", "of that, by luminance that stays", true, false, mechanism<0>},
    Kind{"contrast_red_green", "of that, by red against green", true, false, mechanism<1>},
    Kind{"contrast_yellow_violet", "of that, by yellow against violet", true, false, mechanism<2>},
    Kind{"contrast_flicker", "of that, by luminance that changes (sequences)", true, false,
         mechanism<3>},
    Kind{"flip", "LDR-FLIP, 0 to 1; knows no gaze", true, false,
         [](const FrameQuality& frame) {
             return frame.flip ? std::optional(frame.flip->mean) : std::nullopt;
         }},
    Kind{"ssim", "SSIM, 1: identical; knows no gaze", false, false,
         [](const FrameQuality& frame) {
             return frame.ssim ? std::optional(frame.ssim->plain) : std::nullopt;
         }},
    Kind{"ssim_weighted", "SSIM weighed by Guenter's line of acuity", false, false,
         [](const FrameQuality& frame) {
             return frame.ssim ? std::optional(frame.ssim->weighted) : std::nullopt;
         }},
    Kind{"psnr_db", "PSNR, dB; knows no gaze", false, true,
         [](const FrameQuality& frame) {
             return frame.psnr_db ? std::optional(frame.psnr_db->plain) : std::nullopt;
         }},
    Kind{"psnr_weighted_db", "PSNR weighed by Guenter's line of acuity, dB", false, true,
         [](const FrameQuality& frame) {
             return frame.psnr_db ? std::optional(frame.psnr_db->weighted) : std::nullopt;
         }},
};

}  // namespace

std::vector<std::pair<std::string, double>> figures_of(const FrameQuality& frame) {
    std::vector<std::pair<std::string, double>> figures;
    for (const Kind& kind : kKinds) {
        if (const auto value = kind.of(frame)) {
            figures.emplace_back(kind.key, *value);
        }
    }
    return figures;
}

void QualityTotals::add(const FrameQuality& frame) {
    static_assert(kKinds.size() == kFigures);
    if (frames_ == 0) {
        pixels_per_degree_ = frame.flip_pixels_per_degree;
    }
    for (std::size_t at = 0; at < kKinds.size(); ++at) {
        const Kind& kind = kKinds[at];
        const auto value = kind.of(frame);
        if (!value) {
            continue;
        }
        Total& total = totals_[at];
        total.sum += kind.decibel ? std::pow(10.0, -*value / 10.0) : *value;
        if (!total.any || (kind.lower_is_better ? *value > total.worst : *value < total.worst)) {
            total.worst = *value;
            total.worst_frame = frames_;
        }
        total.any = true;
    }
    ++frames_;
}

std::vector<QualityFigure> QualityTotals::figures() const {
    std::vector<QualityFigure> figures;
    for (std::size_t at = 0; at < kKinds.size(); ++at) {
        const Kind& kind = kKinds[at];
        const Total& total = totals_[at];
        if (!total.any) {
            continue;
        }
        const double mean = total.sum / static_cast<double>(frames_);
        figures.push_back({.key = kind.key,
                           .meaning = kind.meaning,
                           .lower_is_better = kind.lower_is_better,
                           .mean = kind.decibel ? -10.0 * std::log10(mean) : mean,
                           .worst = total.worst,
                           .worst_frame = total.worst_frame});
        if (figures.back().key == "flip") {
            figures.back().meaning += fmt::format(" ({:.3g} px/deg)", pixels_per_degree_);
        }
    }
    return figures;
}

}  // namespace gazeloop::quality
