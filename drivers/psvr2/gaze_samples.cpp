#include "drivers/psvr2/gaze_samples.h"

#include <fmt/format.h>

#include <utility>

#include "drivers/psvr2/stream_keeper.h"

namespace gazeloop::drivers::psvr2 {

std::optional<gaze::GazeSample> GazeSamples::take(std::span<const std::uint8_t> bytes,
                                                  std::int64_t arrived_ns) {
    ++counts_.reports;
    const auto packet = decode_gaze_packet(bytes);
    if (!packet) {
        refuse(packet.error(), bytes.size());
        return std::nullopt;
    }
    if (counts_.samples == 0) {
        notices_.push_back(fmt::format("packets of version {}, user calibration {}",
                                       packet->version, packet->calibration_id));
    }
    const AxesVerdict before = axes_.verdict();
    const bool agrees = axes_.agrees(*packet);
    tell_axes(before);
    const bool contradicts = !agrees && axes_.verdict() != AxesVerdict::Unchecked &&
                             (packet->eyes[0].direction || packet->eyes[1].direction);
    counts_.damaged += packet->implausible > 0 || contradicts ? 1 : 0;

    gaze::GazeSample sample;
    for (const gaze::Eye eye : gaze::kEyes) {
        const EyeBlock& block = packet->eyes[gaze::index(eye)];
        gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
        if (block.blink) {
            ray.openness = *block.blink ? 0.0 : 1.0;
        }
        if (block.pupil_mm) {
            pupils_mm_[gaze::index(eye)] = block.pupil_mm;
        }
        if (agrees && block.direction) {
            ray.direction = axes_.to_head(*block.direction);
            ray.valid = !block.blink.value_or(false);
        }
        if (agrees && block.origin_mm) {
            ray.origin_m = axes_.to_head(*block.origin_mm) * 1e-3;
        }
    }
    clock_.stamp(timestamp_.unwrapped_us(*packet), arrived_ns, sample);

    const std::uint32_t missing = packet->frame - last_frame_ - 1;  // modulo 2^32
    constexpr std::uint32_t kMostInAPause = 1000;
    const bool flowing =
        counts_.samples > 0 && arrived_ns - last_arrived_ns_ < StreamKeeper::kSilence_ns;
    lost_before_last_ = flowing && missing < kMostInAPause ? missing : 0;
    counts_.lost += lost_before_last_;
    last_frame_ = packet->frame;
    last_arrived_ns_ = arrived_ns;
    ++counts_.samples;
    return sample;
}

void GazeSamples::refuse(PacketFault fault, std::size_t bytes) {
    if (fault == PacketFault::Calibration || fault == PacketFault::Raw) {
        ++counts_.others;
        return;
    }
    ++counts_.damaged;
    if (!std::exchange(told_damaged_, true)) {
        constexpr std::string_view kWhat[]{"of that length", "that begin so", "of the size stated"};
        notices_.push_back(fmt::format("{} bytes came that are no gaze packet: there are none {}",
                                       bytes, kWhat[static_cast<std::size_t>(fault)]));
    }
}

void GazeSamples::tell_axes(AxesVerdict before) {
    if (axes_.verdict() == before) {
        return;
    }
    switch (axes_.verdict()) {
        case AxesVerdict::Unchecked:
            break;
        case AxesVerdict::AsPublished:
            notices_.emplace_back("axes: as published (left eye left, gaze forward)");
            break;
        case AxesVerdict::Unconfirmed:
            notices_.emplace_back(
                "axes: taken as published; the eyes' places, which could confirm it, do not come");
            break;
        case AxesVerdict::FromData:
            notices_.emplace_back(
                "axes: NOT as published; taken from where the eyes are and look. Please report it");
            break;
        case AxesVerdict::Contradictory:
            notices_.emplace_back(
                "axes: the eyes' places contradict each other: no gaze is used until they agree. "
                "Please report it");
            break;
    }
}

std::optional<std::string> GazeSamples::take_change() {
    if (!notices_.empty()) {
        std::string line = std::move(notices_.front());
        notices_.pop_front();
        return line;
    }
    return clock_.take_change();
}

}  // namespace gazeloop::drivers::psvr2
