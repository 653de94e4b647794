#pragma once

#include "drivers/hid/report_descriptor.h"

/// Usage page 0x12, Eye and Head Trackers (HID Usage Tables 1.3, chapter 15).
namespace gazeloop::drivers::hid::eye_tracker {

inline constexpr std::uint16_t kPage = 0x12;

// Collections.
inline constexpr Usage kEyeTracker = usage(kPage, 0x01);
inline constexpr Usage kTrackingData = usage(kPage, 0x10);
inline constexpr Usage kCapabilities = usage(kPage, 0x11);
inline constexpr Usage kConfiguration = usage(kPage, 0x12);
inline constexpr Usage kStatus = usage(kPage, 0x13);
inline constexpr Usage kControl = usage(kPage, 0x14);

inline constexpr Usage kSensorTimestamp = usage(kPage, 0x20);
inline constexpr Usage kPositionX = usage(kPage, 0x21);
inline constexpr Usage kPositionY = usage(kPage, 0x22);
inline constexpr Usage kPositionZ = usage(kPage, 0x23);
inline constexpr Usage kGazePoint = usage(kPage, 0x24);
inline constexpr Usage kLeftEyePosition = usage(kPage, 0x25);
inline constexpr Usage kRightEyePosition = usage(kPage, 0x26);

inline constexpr Usage kTrackerQuality = usage(kPage, 0x100);
inline constexpr Usage kMinimumTrackingDistance = usage(kPage, 0x101);
inline constexpr Usage kOptimumTrackingDistance = usage(kPage, 0x102);
inline constexpr Usage kMaximumTrackingDistance = usage(kPage, 0x103);
inline constexpr Usage kMaximumScreenPlaneWidth = usage(kPage, 0x104);
inline constexpr Usage kMaximumScreenPlaneHeight = usage(kPage, 0x105);

inline constexpr Usage kDisplayManufacturerId = usage(kPage, 0x200);
inline constexpr Usage kDisplayProductId = usage(kPage, 0x201);
inline constexpr Usage kDisplaySerialNumber = usage(kPage, 0x202);
inline constexpr Usage kDisplayManufacturerDate = usage(kPage, 0x203);
inline constexpr Usage kCalibratedScreenWidth = usage(kPage, 0x204);
inline constexpr Usage kCalibratedScreenHeight = usage(kPage, 0x205);

inline constexpr Usage kSamplingFrequency = usage(kPage, 0x300);
inline constexpr Usage kConfigurationStatus = usage(kPage, 0x301);

inline constexpr Usage kDeviceModeRequest = usage(kPage, 0x400);

}  // namespace gazeloop::drivers::hid::eye_tracker
