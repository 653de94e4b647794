#include "runtime/numerics/envelope_text.h"

#include <fmt/core.h>

#include "runtime/numerics/envelope_groups.h"

namespace gazeloop::numerics {

std::string verdict(const Envelope& envelope) {
    const EnvelopeCounts counts = envelope.counts();
    return fmt::format(
        "{} of {} maps and gazes meet their targets, {} of them not .01 px (off screen and above "
        "4096 px: .05) but twice what float32 alone costs there; {} more are useless maps, however "
        "exact; of {} random extreme draws {} are not finite and {} lie outside the LP-buffer.",
        counts.met, counts.useful, counts.for_float32, counts.useless, envelope.draws,
        envelope.draws_not_finite, envelope.draws_outside);
}

std::string envelope_text(const Envelope& envelope) {
    std::string text = fmt::format(
        "The numerical envelope on {} ({}): largest errors against double precision, px\n\n",
        envelope.device, envelope.driver);
    text += fmt::format("{:24} {:11} {:6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}  {}\n",
                        "map", "picture", "fovea", "float", "device", "bound", "float32", "target",
                        "texels", "seam", "fall", "");
    for (const EnvelopeGroup& group : grouped(envelope)) {
        text += fmt::format(
            "{:24} {:11} {:6} {:8.5f} {:8.5f} {:8.5f} {:8.5f} {:8.5f} {:8.5f} {:8.5f} {:8.5f}  {}",
            group.map, fmt::format("{}x{}", group.image.width_px, group.image.height_px),
            group.on_screen ? "on" : "off", group.cpu_px, group.device_px, group.bound_px,
            group.conditioning_px, group.target_px, group.texels, group.seam_px, group.fall_px,
            group.met ? "met" : "MISSED");
        if (group.beyond_bound > 0) {
            text += fmt::format("; {} beyond their bound", group.beyond_bound);
        }
        if (group.not_finite > 0) {
            text += fmt::format("; {} not finite", group.not_finite);
        }
        if (group.useless > 0) {
            text += fmt::format("; {} of {} useless ({}: {})", group.useless, group.rows,
                                group.useless_where, group.why_useless);
        }
        text += '\n';
    }
    text += fmt::format(
        "\nfloat: the shader's arithmetic on the CPU; device: the shader; bound: derived; "
        "float32:\n"
        "what a float u and v cost alone: all of the sigma and gaze that come closest to their\n"
        "target (of those with useful parameters). texels: the forward error in columns; seam: "
        "beside "
        "the\nwrap of the angle; fall: steps back of u.\n\n"
        "Building the tables of one eye of 2160x2160, ms:");
    for (const TableBuild& build : envelope.tables) {
        text += fmt::format(" {} {:.3f};", build.map, build.milliseconds);
    }
    text += fmt::format("\n{} Measured in {:.1f} s.\n", verdict(envelope), envelope.seconds);
    return text;
}

}  // namespace gazeloop::numerics
