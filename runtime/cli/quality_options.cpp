#include "runtime/cli/quality_options.h"

namespace gazeloop::cli {

std::vector<Option> QualityOptions::add_to(Command command, std::vector<std::string>* gazes) {
    std::vector<Option> options;
    const std::string meaning =
        "direction of gaze, degrees to the right and up, or a trace whose first sample is the "
        "first "
        "frame's";
    if (gazes == nullptr) {
        options.push_back(command.option("--gaze", gaze, meaning).type("AZ,EL|trace:FILE"));
    } else {
        options.push_back(command.option("--gaze", *gazes, meaning + "; may be repeated")
                              .type("AZ,EL|trace:FILE"));
    }
    options.push_back(command.option("--eye", eye, "whose view is compared: left or right")
                          .one_of({"left", "right"}));
    options.push_back(command.option(
        "--metric", metrics, "contrast, flip, ssim or psnr; may be repeated; all without it"));
    options.push_back(
        command.option("--peak", light.peak_cd_m2, "luminance of the display's white, cd/m2 (100)")
            .number_between(quality::DisplayLight::kMinPeak, quality::DisplayLight::kMaxPeak));
    options.push_back(
        command
            .option("--black", light.black_cd_m2,
                    "what is added to all luminance by leaks and stray light, cd/m2 (0.1)")
            .number_between(0.0, quality::DisplayLight::kMaxPeak));
    options.push_back(
        command
            .option("--threads", threads,
                    "metrics use at most so many; as many as the machine has without it")
            .whole_number(64));
    return options;
}

}  // namespace gazeloop::cli
