#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "drivers/hid/eye_tracker_usages.h"

namespace gazeloop::drivers::hid {

/// Writes a report descriptor item by item.
class DescriptorItems {
  public:
    static constexpr std::uint32_t kData = 0;
    static constexpr std::uint32_t kConstant = 1;
    static constexpr std::uint32_t kVariable = 2;
    static constexpr std::uint32_t kNullState = 0x40;

    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

    DescriptorItems& raw(std::initializer_list<int> values) {
        for (const int value : values) {
            bytes_.push_back(static_cast<std::uint8_t>(value));
        }
        return *this;
    }
    /// A short item with `size` (0, 1, 2, 4) bytes of data.
    DescriptorItems& item(unsigned tag_and_type, unsigned size, std::uint32_t value) {
        bytes_.push_back(static_cast<std::uint8_t>(tag_and_type | (size == 4 ? 3U : size)));
        for (unsigned i = 0; i < size; ++i) {
            bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
        }
        return *this;
    }
    DescriptorItems& page(std::uint32_t page) { return item(0x04, 1, page); }
    DescriptorItems& logical(std::int32_t minimum, std::int32_t maximum) {
        item(0x14, 4, static_cast<std::uint32_t>(minimum));
        return item(0x24, 4, static_cast<std::uint32_t>(maximum));
    }
    DescriptorItems& physical(std::int32_t minimum, std::int32_t maximum) {
        item(0x34, 4, static_cast<std::uint32_t>(minimum));
        return item(0x44, 4, static_cast<std::uint32_t>(maximum));
    }
    DescriptorItems& exponent(std::uint32_t nibble) { return item(0x54, 1, nibble); }
    DescriptorItems& unit(std::uint32_t unit) { return item(0x64, 4, unit); }
    DescriptorItems& fields(std::uint32_t size, std::uint32_t count) {
        item(0x74, 1, size);
        return item(0x94, 2, count);
    }
    DescriptorItems& report_id(std::uint32_t id) { return item(0x84, 1, id); }
    DescriptorItems& usage(Usage usage) { return item(0x08, 2, usage & 0xFFFFU); }
    DescriptorItems& open(CollectionType type, Usage of) {
        usage(of);
        return item(0xA0, 1, static_cast<std::uint32_t>(type));
    }
    DescriptorItems& close() { return item(0xC0, 0, 0); }
    DescriptorItems& input(std::uint32_t flags) { return item(0x80, 1, flags); }
    DescriptorItems& output(std::uint32_t flags) { return item(0x90, 1, flags); }
    DescriptorItems& feature(std::uint32_t flags) { return item(0xB0, 1, flags); }

  private:
    std::vector<std::uint8_t> bytes_;
};

/// The first published layout: micrometres as centimetres with exponent -4, positions flagged
/// Constant, the timestamp an array of bytes, five reports.
inline std::vector<std::uint8_t> first_layout() {
    using namespace eye_tracker;
    constexpr auto kConstantVariable = DescriptorItems::kConstant | DescriptorItems::kVariable;
    constexpr auto kDataVariable = DescriptorItems::kVariable;
    DescriptorItems d;
    d.page(kPage).open(CollectionType::Application, kEyeTracker);

    d.report_id(0x10).open(CollectionType::Physical, kTrackingData);
    d.usage(kSensorTimestamp).logical(0, 255).fields(8, 8).input(DescriptorItems::kConstant);
    d.unit(0x11).exponent(0x0C).logical(-2'000'000, 2'000'000);
    d.open(CollectionType::Physical, kGazePoint).usage(kPositionX).usage(kPositionY);
    d.fields(32, 2).input(kConstantVariable).close();
    for (const Usage eye : {kLeftEyePosition, kRightEyePosition}) {
        d.open(CollectionType::Physical, eye);
        d.usage(kPositionX).usage(kPositionY).usage(kPositionZ);
        d.fields(32, 3).input(kConstantVariable).close();
    }
    d.fields(32, 6).input(DescriptorItems::kConstant);
    d.close();

    d.report_id(0x11).open(CollectionType::Logical, kCapabilities);
    d.item(0x64, 1, 0).exponent(0).logical(0, 255);
    d.usage(kTrackerQuality).fields(8, 1).feature(kDataVariable);
    d.unit(0x11).exponent(0x0C).logical(0, 0x7FFFFFFF);
    for (const Usage usage :
         {kMinimumTrackingDistance, kOptimumTrackingDistance, kMaximumTrackingDistance,
          kMaximumScreenPlaneWidth, kMaximumScreenPlaneHeight}) {
        d.usage(usage);
    }
    d.fields(32, 5).feature(kDataVariable).close();

    d.report_id(0x12).open(CollectionType::Logical, kConfiguration);
    d.item(0x64, 1, 0).exponent(0).logical(0, 0xFFFF);
    d.usage(kDisplayManufacturerId).usage(kDisplayProductId).fields(16, 2).feature(kDataVariable);
    d.logical(0, 0x7FFFFFFF).usage(kDisplaySerialNumber).fields(32, 1).feature(kDataVariable);
    d.logical(0, 0xFFFF).usage(kDisplayManufacturerDate).fields(16, 1).feature(kDataVariable);
    d.unit(0x11).exponent(0x0C).logical(0, 0x7FFFFFFF);
    d.usage(kCalibratedScreenWidth).usage(kCalibratedScreenHeight).fields(32, 2);
    d.feature(kDataVariable).close();

    d.report_id(0x13).open(CollectionType::Logical, kStatus);
    d.item(0x64, 1, 0).exponent(0);
    for (const bool is_input : {false, true}) {
        d.logical(0, 255).usage(kConfigurationStatus).fields(8, 1);
        is_input ? d.input(kDataVariable) : d.feature(kDataVariable);
        d.logical(0, 0xFFFF).usage(kSamplingFrequency).fields(16, 1);
        is_input ? d.input(kDataVariable) : d.feature(kDataVariable);
    }
    d.close();

    d.report_id(0x14).open(CollectionType::Logical, kControl);
    d.logical(0, 255).usage(kDeviceModeRequest).fields(8, 1).feature(kDataVariable).close();
    d.close();
    return d.bytes();
}

/// The second published layout: three bytes of padding before one 64-bit timestamp, no units, the
/// rotations where others have the head's direction; without eyes where `eyes` is false.
inline std::vector<std::uint8_t> second_layout(bool eyes = true) {
    using namespace eye_tracker;
    DescriptorItems d;
    d.page(kPage).open(CollectionType::Application, kEyeTracker);
    d.report_id(0x01).open(CollectionType::Physical, kTrackingData);
    d.fields(8, 3).input(DescriptorItems::kConstant);
    d.usage(kSensorTimestamp).fields(64, 1).input(DescriptorItems::kVariable);
    d.logical(-0x7FFFFFFF, 0x7FFFFFFF);
    d.open(CollectionType::Physical, kGazePoint).usage(kPositionX).usage(kPositionY);
    d.fields(32, 2).input(DescriptorItems::kVariable).close();
    if (eyes) {
        for (const Usage eye : {kLeftEyePosition, kRightEyePosition}) {
            d.open(CollectionType::Physical, eye);
            d.usage(kPositionX).usage(kPositionY).usage(kPositionZ);
            d.fields(32, 3).input(DescriptorItems::kVariable).close();
        }
    }
    d.open(CollectionType::Physical, usage(kPage, 0x27));
    for (const std::uint16_t rotation : std::initializer_list<std::uint16_t>{0x28, 0x29, 0x2A}) {
        d.usage(usage(kPage, rotation));
    }
    d.fields(32, 3).input(DescriptorItems::kVariable).close();
    d.close().close();
    return d.bytes();
}

}  // namespace gazeloop::drivers::hid
