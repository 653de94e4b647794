#pragma once

#include <openxr/openxr.h>

#include <array>
#include <cstdint>

/// What the layer must know of OpenXR after 1.0.20, the headers of Debian 12. Names and values are
/// those of the registry; in a namespace of their own, so that newer headers do no harm.
namespace gazeloop::openxr_layer::newer {

// XR_KHR_locate_spaces, core in 1.1.

inline constexpr auto kSpacesLocateInfo = static_cast<XrStructureType>(1000471000);
inline constexpr auto kSpaceLocations = static_cast<XrStructureType>(1000471001);
inline constexpr auto kSpaceVelocities = static_cast<XrStructureType>(1000471002);

struct SpacesLocateInfo {
    XrStructureType type;
    const void* next;
    XrSpace baseSpace;
    XrTime time;
    std::uint32_t spaceCount;
    const XrSpace* spaces;
};

struct SpaceLocationData {
    XrSpaceLocationFlags locationFlags;
    XrPosef pose;
};

struct SpaceLocations {
    XrStructureType type;
    void* next;
    std::uint32_t locationCount;
    SpaceLocationData* locations;
};

struct SpaceVelocityData {
    XrSpaceVelocityFlags velocityFlags;
    XrVector3f linearVelocity;
    XrVector3f angularVelocity;
};

struct SpaceVelocities {
    XrStructureType type;
    void* next;
    std::uint32_t velocityCount;
    SpaceVelocityData* velocities;
};

using LocateSpaces = XrResult(XRAPI_PTR*)(XrSession, const SpacesLocateInfo*, SpaceLocations*);

// XR_META_foveation_eye_tracked.

inline constexpr const char* kFoveationEyeTrackedName = "XR_META_foveation_eye_tracked";
inline constexpr auto kFoveationEyeTrackedState = static_cast<XrStructureType>(1000200001);
inline constexpr auto kSystemFoveationEyeTrackedProperties =
    static_cast<XrStructureType>(1000200002);
inline constexpr XrFlags64 kFoveationEyeTrackedStateValid = 1;

struct FoveationEyeTrackedState {
    XrStructureType type;
    void* next;
    XrVector2f foveationCenter[2];
    XrFlags64 flags;
};

struct SystemFoveationEyeTrackedProperties {
    XrStructureType type;
    void* next;
    XrBool32 supportsFoveationEyeTracked;
};

using GetFoveationEyeTrackedState = XrResult(XRAPI_PTR*)(XrSession, FoveationEyeTrackedState*);

}  // namespace gazeloop::openxr_layer::newer
