#pragma once

#include <cstdint>
#include <optional>

#include "runtime/openxr_layer/hook.h"
#include "runtime/openxr_layer/placed_gaze.h"

namespace gazeloop::openxr_layer {

/// The gaze that an application is given, as it was when it asked.
struct GivenGaze {
    GazeInHead in_head;
    bool nominal = false;
    std::int64_t time_ns = 0;  ///< host time
    bool time_known = false;   ///< of the eyes, not of the arrival
    XrTime time = 0;           ///< the same on the runtime's time line; 0: it has none for it
};

/// A gaze space of a session, as far as it is to be located.
struct LocatedSpace {
    GazeSpace space;
    bool gives_gaze = false;  ///< driven by the eyes, and permitted
};

/// What a locating call needs of a session.
struct Locating {
    XrSession session = XR_NULL_HANDLE;
    XrSpace view_space = XR_NULL_HANDLE;
    std::shared_ptr<GazeFeed> feed;
    TimeLine times;
    std::optional<LocatedSpace> space;  ///< none: it is not the gaze's
    std::optional<LocatedSpace> base;
};

/// Of a space and the one that it is to be located in; none where neither is the gaze's.
[[nodiscard]] std::optional<Locating> locating(LayeredInstance& layered, XrSpace space,
                                               XrSpace base);

/// The gaze at a time of the runtime's. `sample`, where it is wanted: what it was made of.
[[nodiscard]] std::optional<GivenGaze> gaze_at(const Locating& locating, XrTime time,
                                               SeenGaze* sample = nullptr);

/// Where the head is in a space, as the runtime says, at the gaze's time; at `otherwise` where it
/// knows no pose for that.
struct HeadLocated {
    XrResult result = XR_SUCCESS;
    bool valid = false;
    bool position_valid = false;
    Moving head;
};
[[nodiscard]] HeadLocated head_in(const NextFunctions& next, XrSpace view_space, XrSpace base,
                                  XrTime time, XrTime otherwise);

/// The application was given gaze of a session.
void note_gaze_read(LayeredInstance& layered, XrSession session);

/// Hands the recording of a session the samples that it has not had. Under the instance's lock and
/// the feed's. Precondition: there is one.
void tell_samples(const LayeredInstance& layered, const LayeredSession& session,
                  const GazeHistory& history);

}  // namespace gazeloop::openxr_layer
