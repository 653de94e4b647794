// From a device's bytes to rays: layout, reports, features, screen.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "drivers/hid/eye_tracker_reports.h"
#include "drivers/hid/screen_gaze.h"
#include "tests/unit/drivers/hid/descriptor_items.h"

namespace gazeloop::drivers::hid {
namespace {

using namespace eye_tracker;
using gaze::Eye;
using gaze::index;
using Items = DescriptorItems;

EyeTrackerLayout layout_of(const std::vector<std::uint8_t>& descriptor) {
    return value_or_throw(find_eye_tracker(value_or_throw(parse_report_descriptor(descriptor))));
}

/// Little-endian numbers one after the other.
class Bytes {
  public:
    template <typename T>
    Bytes& add(T value) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof(T));
        std::memcpy(bytes_.data() + at, &value, sizeof(T));
        return *this;
    }
    template <typename T>
    Bytes& add(std::initializer_list<T> values) {
        for (const T value : values) {
            add(value);
        }
        return *this;
    }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  private:
    std::vector<std::uint8_t> bytes_;
};

constexpr std::int32_t kNoData = std::numeric_limits<std::int32_t>::max();

/// A report 0x10 of the first layout: looks at (200, 100) mm from (170, 160, 600) and (230, ...).
Bytes first_report(std::int32_t gaze_x_um = 200'000, std::int32_t right_z_um = 600'000) {
    Bytes bytes;
    bytes.add(std::uint8_t{0x10}).add(std::uint64_t{0x0102030405060708});
    bytes.add<std::int32_t>({gaze_x_um, 100'000});
    bytes.add<std::int32_t>({170'000, 160'000, 600'000});
    bytes.add<std::int32_t>({230'000, 160'000, right_z_um});
    bytes.add<std::int32_t>({0, 0, 0, 0, 0, 0});
    return bytes;
}

TrackingReport tracking(const EyeTrackerLayout& layout, const std::vector<std::uint8_t>& bytes) {
    const InputReport report = decode_input(layout, bytes);
    EXPECT_TRUE(std::holds_alternative<TrackingReport>(report));
    return std::holds_alternative<TrackingReport>(report) ? std::get<TrackingReport>(report)
                                                          : TrackingReport{};
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(actual - expected), 1e-12)
        << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(EyeTracker, FirstLayoutsBytesAreAsPublished) {
    EXPECT_EQ(first_report().bytes().size(), 65U);
    const EyeTrackerLayout layout = layout_of(first_layout());
    EXPECT_EQ(find_report(layout.reports, ReportKind::Input, 0x10)->payload_bytes(), 64U);
    EXPECT_EQ(find_report(layout.reports, ReportKind::Feature, 0x11)->payload_bytes(), 21U);
    EXPECT_EQ(find_report(layout.reports, ReportKind::Feature, 0x12)->payload_bytes(), 18U);
    EXPECT_EQ(find_report(layout.reports, ReportKind::Feature, 0x13)->payload_bytes(), 3U);
    EXPECT_EQ(find_report(layout.reports, ReportKind::Input, 0x13)->payload_bytes(), 3U);
    EXPECT_EQ(find_report(layout.reports, ReportKind::Feature, 0x14)->payload_bytes(), 1U);
    ASSERT_EQ(layout.tracking.size(), 1U);
    EXPECT_EQ(layout.tracking[0].gaze_point[0]->bit_offset, 64U);
    EXPECT_EQ(layout.tracking[0].eye_position[0][0]->bit_offset, 128U);
    EXPECT_EQ(layout.tracking[0].eye_position[1][0]->bit_offset, 224U);
    EXPECT_EQ(layout.tracking[0].timestamp,
              (TimestampField{.bit_offset = 0, .bits = 64, .range = {}, .tick_ns = 1000.0}));
    EXPECT_EQ(layout.feature_ids(), (std::vector<std::uint8_t>{0x12, 0x13, 0x11}));
}

TEST(EyeTracker, PositionsFlaggedConstantAreRead) {
    const TrackingReport report = tracking(layout_of(first_layout()), first_report().bytes());
    EXPECT_EQ(report.ticks, 0x0102030405060708U);
    ASSERT_TRUE(report.gaze_m && report.eye_m[0] && report.eye_m[1]);
    expect_near({*report.gaze_m, 0.0}, {0.2, 0.1, 0.0});
    expect_near(*report.eye_m[0], {0.17, 0.16, 0.6});
    expect_near(*report.eye_m[1], {0.23, 0.16, 0.6});
    EXPECT_FALSE(report.truncated);
}

TEST(EyeTracker, SecondLayoutIsFoundBehindItsPaddingAndWithoutUnits) {
    Bytes bytes;
    bytes.add(std::uint8_t{0x01}).add<std::uint8_t>({9, 9, 9}).add(std::uint64_t{1'234'567});
    bytes.add<std::int32_t>({-200'000, 100'000, 170'000, 160'000, 600'000, 230'000, 160'000});
    bytes.add<std::int32_t>({600'000, 1, 2, 3});
    const EyeTrackerLayout layout = layout_of(second_layout());
    EXPECT_EQ(layout.tracking[0].timestamp,
              (TimestampField{.bit_offset = 24, .bits = 64, .range = {}, .tick_ns = 1000.0}));
    const TrackingReport report = tracking(layout, bytes.bytes());
    EXPECT_EQ(report.ticks, 1'234'567U);
    ASSERT_TRUE(report.gaze_m && report.eye_m[1]);
    expect_near({*report.gaze_m, 0.0}, {-0.2, 0.1, 0.0});
    expect_near(*report.eye_m[1], {0.23, 0.16, 0.6});
    EXPECT_FALSE(layout.mode_request.has_value());
    EXPECT_FALSE(encode_mode_request(layout, kModeGaze).has_value());
}

TEST(EyeTracker, GreatestNumberAndNumbersOutOfRangeAreNoData) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    EXPECT_FALSE(tracking(layout, first_report(kNoData).bytes()).gaze_m.has_value());
    EXPECT_FALSE(tracking(layout, first_report(2'000'001).bytes()).gaze_m.has_value());
    EXPECT_TRUE(tracking(layout, first_report(2'000'000).bytes()).gaze_m.has_value());
    EXPECT_TRUE(tracking(layout, first_report(-2'000'000).bytes()).gaze_m.has_value());
    EXPECT_FALSE(tracking(layout, first_report(-2'000'001).bytes()).gaze_m.has_value());
    const TrackingReport one_eye = tracking(layout, first_report(0, kNoData).bytes());
    EXPECT_TRUE(one_eye.eye_m[0].has_value());
    EXPECT_FALSE(one_eye.eye_m[1].has_value());
    // The second layout allows the whole range but for the least number.
    Bytes bytes;
    bytes.add(std::uint8_t{0x01}).add<std::uint8_t>({0, 0, 0}).add(std::uint64_t{5});
    bytes.add<std::int32_t>({kNoData, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_FALSE(tracking(layout_of(second_layout()), bytes.bytes()).gaze_m.has_value());
}

TEST(EyeTracker, ShortReportsGiveWhatTheyHave) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    const std::vector<std::uint8_t> whole = first_report().bytes();
    for (std::size_t length = 1; length < whole.size(); ++length) {
        const TrackingReport report =
            tracking(layout, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
        EXPECT_TRUE(report.truncated);
        EXPECT_EQ(report.ticks.has_value(), length >= 9) << length;
        EXPECT_EQ(report.gaze_m.has_value(), length >= 17) << length;
        EXPECT_EQ(report.eye_m[0].has_value(), length >= 29) << length;
        EXPECT_EQ(report.eye_m[1].has_value(), length >= 41) << length;
    }
    EXPECT_TRUE(std::holds_alternative<OtherReport>(decode_input(layout, {})));
    std::vector<std::uint8_t> longer = whole;
    longer.resize(300);
    EXPECT_TRUE(tracking(layout, longer).gaze_m.has_value());
    EXPECT_FALSE(tracking(layout, longer).truncated);
}

TEST(EyeTracker, UnknownReportIdsAreSomethingElse) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    std::vector<std::uint8_t> bytes = first_report().bytes();
    bytes[0] = 0x77;
    EXPECT_TRUE(std::holds_alternative<OtherReport>(decode_input(layout, bytes)));
}

TEST(EyeTracker, SeveralTrackingReportsAreReadEachByItsOwnId) {
    Items d;
    d.page(kPage).open(CollectionType::Application, kEyeTracker).logical(-32768, 32767);
    d.unit(0x11).exponent(0x0E);  // 0.1 mm
    for (const std::uint32_t id : {3U, 4U}) {
        d.report_id(id).open(CollectionType::Logical, kGazePoint);
        if (id == 4) {
            d.fields(5, 1).input(Items::kConstant);  // no whole byte
        }
        d.usage(kPositionX).usage(kPositionY).fields(16, 2).input(Items::kVariable).close();
    }
    d.close();
    const EyeTrackerLayout layout = layout_of(d.bytes());
    ASSERT_EQ(layout.tracking.size(), 2U);
    const TrackingReport third = tracking(layout, {3, 0x10, 0x27, 0xF0, 0xD8});
    expect_near({*third.gaze_m, 0.0}, {1.0, -1.0, 0.0});
    EXPECT_FALSE(third.ticks.has_value());
    // 10000 << 5 and -10000 << 21, over five bits that are set.
    std::vector<std::uint8_t> shifted(6, 0);
    shifted[0] = 4;
    write_bits(std::span(shifted).subspan(1), 0, 5, 0x1F);
    write_bits(std::span(shifted).subspan(1), 5, 16, 10000);
    write_bits(std::span(shifted).subspan(1), 21, 16, static_cast<std::uint16_t>(-10000));
    const TrackingReport fourth = tracking(layout, shifted);
    expect_near({*fourth.gaze_m, 0.0}, {1.0, -1.0, 0.0});
}

// What a counter runs through is what its field states, where that can be.
TEST(EyeTracker, TimestampsWrapAfterTheRangeThatTheirFieldStates) {
    const auto range_of = [](std::uint32_t bits, std::uint32_t parts, const Items& range) {
        Items d;
        d.page(kPage).open(CollectionType::Application, kEyeTracker);
        for (const std::uint8_t byte : range.bytes()) {
            d.raw({byte});
        }
        d.usage(kSensorTimestamp).fields(bits, parts).input(Items::kVariable);
        d.usage(kGazePoint).fields(32, 2).input(Items::kVariable).close();
        return layout_of(d.bytes()).tracking.at(0).timestamp.value().range;
    };
    const auto stated = [&](std::uint32_t bits, std::int32_t least, std::int32_t greatest) {
        return range_of(bits, 1, Items().logical(least, greatest));
    };
    const auto of_bits = time::TickRange::of_bits;
    EXPECT_EQ(stated(32, 0, 0x7FFFFFFF), of_bits(31));
    EXPECT_EQ(stated(32, 0, 0xFFFF), of_bits(16));
    EXPECT_EQ(stated(32, 0, -1), of_bits(32)) << "0xFFFFFFFF beside a minimum that is not negative";
    EXPECT_EQ(stated(32, 0, 999'999), (time::TickRange{.least = 0, .span = 999'999}));
    EXPECT_EQ(stated(32, 1, 1000), (time::TickRange{.least = 1, .span = 999}));
    EXPECT_EQ(stated(32, std::numeric_limits<std::int32_t>::min(), 0x7FFFFFFF),
              time::TickRange::of_signed_bits(32));
    EXPECT_EQ(stated(16, -32768, 32767), time::TickRange::of_signed_bits(16));
    EXPECT_EQ(stated(16, -32767, 32767), time::TickRange::of_signed_bits(16));
    EXPECT_EQ(stated(16, -500, 500), (time::TickRange{.least = -500, .span = 1000}));
    EXPECT_EQ(stated(24, 0, 0), of_bits(24)) << "none";
    EXPECT_EQ(stated(24, 7, 3), of_bits(24)) << "the wrong way round";
    EXPECT_EQ(stated(16, 0, 0x7FFFFFFF), of_bits(16)) << "more than the field can hold";
    EXPECT_EQ(stated(16, -32769, 0), of_bits(16)) << "less than the field can hold";
    EXPECT_EQ(stated(64, 0, 0x7FFFFFFF), of_bits(31));
    EXPECT_EQ(range_of(32, 1, Items()), of_bits(32));
    EXPECT_EQ(range_of(8, 4, Items().logical(0, 255)), of_bits(32)) << "the range of its bytes";
    EXPECT_EQ(range_of(8, 4, Items().logical(0, 127)), of_bits(32));
}

TEST(EyeTracker, SignedTimestampsAreReadWithTheirSign) {
    TimestampField field{.bit_offset = 4, .bits = 16, .range = {}, .tick_ns = 1.0};
    std::vector<std::uint8_t> payload(3);
    write_bits(payload, 4, 16, 0xFFFE);
    EXPECT_EQ(field.ticks(payload), 0xFFFEU);
    field.range = time::TickRange::of_signed_bits(16);
    EXPECT_EQ(field.ticks(payload), static_cast<std::uint64_t>(-2));
    EXPECT_EQ(field.held_in(), time::TickRange::of_signed_bits(16));
    write_bits(payload, 4, 16, 0x7FFF);
    EXPECT_EQ(field.ticks(payload), 0x7FFFU);
    EXPECT_FALSE(field.ticks(std::span(payload).first(2)).has_value());
}

TEST(EyeTracker, DevicesWithoutReportIdsBeginWithTheData) {
    Items d;
    d.page(kPage).open(CollectionType::Application, kEyeTracker);
    d.usage(kSensorTimestamp).fields(32, 1).unit(0x1001).exponent(0x0D).input(Items::kVariable);
    d.usage(kGazePoint).fields(32, 2).input(Items::kVariable).close();  // a point in one field
    const EyeTrackerLayout layout = layout_of(d.bytes());
    EXPECT_FALSE(layout.numbered);
    EXPECT_EQ(
        layout.tracking[0].timestamp,
        (TimestampField{
            .bit_offset = 0, .bits = 32, .range = time::TickRange::of_bits(32), .tick_ns = 1e6}))
        << "milliseconds, as the unit says";
    // No logical range, and a unit of time left over: signed micrometres.
    Bytes bytes;
    bytes.add(std::uint32_t{77}).add<std::int32_t>({-1000, 2000});
    const TrackingReport report = tracking(layout, bytes.bytes());
    EXPECT_EQ(report.ticks, 77U);
    expect_near({*report.gaze_m, 0.0}, {-0.001, 0.002, 0.0});
}

TEST(EyeTracker, UnitsAndPhysicalExtentsScale) {
    const auto gaze_x_m = [](std::uint32_t unit, std::uint32_t exponent, bool physical) {
        Items d;
        d.page(kPage).open(CollectionType::Application, kEyeTracker);
        d.open(CollectionType::Physical, kGazePoint).logical(0, 1000);
        if (physical) {
            d.physical(-50, 150);
        }
        d.unit(unit).exponent(exponent).usage(kPositionX).usage(kPositionY);
        d.fields(16, 2).input(Items::kVariable).close().close();
        Bytes bytes;
        bytes.add<std::uint16_t>({250, 0});
        return tracking(layout_of(d.bytes()), bytes.bytes()).gaze_m->x;
    };
    EXPECT_DOUBLE_EQ(gaze_x_m(0x11, 0, false), 2.5);      // centimetres
    EXPECT_DOUBLE_EQ(gaze_x_m(0x11, 0xE, false), 0.025);  // .1 mm
    EXPECT_DOUBLE_EQ(gaze_x_m(0x13, 0xF, false), 0.635);  // tenths of an inch
    EXPECT_DOUBLE_EQ(gaze_x_m(0x11, 0, true), 0.0);       // a quarter of the way from -50 to 150 cm
    EXPECT_DOUBLE_EQ(gaze_x_m(0, 0, false), 250e-6);
    EXPECT_DOUBLE_EQ(gaze_x_m(0x14, 0xC, false), 250e-6) << "degrees are no length: left over";
}

TEST(EyeTracker, RefusesWhatIsNoEyeTracker) {
    Items mouse;
    mouse.page(1).open(CollectionType::Application, 2).close();
    const auto parsed = value_or_throw(parse_report_descriptor(mouse.bytes()));
    EXPECT_FALSE(describes_eye_tracker(parsed));
    EXPECT_NE(find_eye_tracker(parsed).error().message.find("usage page 0x12"), std::string::npos);
    Items blind;
    blind.page(kPage).open(CollectionType::Application, kEyeTracker);
    blind.usage(kSensorTimestamp).fields(32, 1).input(Items::kVariable).close();
    const auto gazeless = value_or_throw(parse_report_descriptor(blind.bytes()));
    EXPECT_TRUE(describes_eye_tracker(gazeless));
    EXPECT_NE(find_eye_tracker(gazeless).error().message.find("gaze point"), std::string::npos);
}

TEST(EyeTracker, PositionsOfOtherCollectionsAreNotTheGaze) {
    Items d;
    d.page(kPage).open(CollectionType::Application, kEyeTracker);
    d.open(CollectionType::Physical, usage(kPage, 0x27)).usage(kPositionX).usage(kPositionY);
    d.fields(32, 2).input(Items::kVariable).close();  // head
    d.open(CollectionType::Physical, kGazePoint).usage(kPositionX).usage(kPositionY);
    d.fields(32, 2).input(Items::kVariable).close().close();
    const EyeTrackerLayout layout = layout_of(d.bytes());
    EXPECT_EQ(layout.tracking[0].gaze_point[0]->bit_offset, 64U);
}

TEST(EyeTracker, StatusComesAsInputAndAsFeature) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    const InputReport input = decode_input(layout, std::vector<std::uint8_t>{0x13, 4, 0x78, 0});
    ASSERT_TRUE(std::holds_alternative<StatusReport>(input));
    EXPECT_EQ(std::get<StatusReport>(input),
              (StatusReport{TrackerStatus::UserCalibrationNeeded, 120}));
    const InputReport odd = decode_input(layout, std::vector<std::uint8_t>{0x13, 99});
    EXPECT_EQ(std::get<StatusReport>(odd), (StatusReport{TrackerStatus::Unknown, std::nullopt}));
}

std::vector<FeatureReport> features_in_um(double factor, std::int32_t screen_width_um = 527'040,
                                          std::int32_t screen_height_um = 296'460,
                                          std::uint16_t hz = 90) {
    const auto um = [factor](double value) { return static_cast<std::int32_t>(value * factor); };
    Bytes capabilities;
    capabilities.add(std::uint8_t{0x11}).add(std::uint8_t{2});
    capabilities.add<std::int32_t>({um(450e3), um(650e3), um(900e3), um(600e3), um(340e3)});
    Bytes configuration;
    configuration.add(std::uint8_t{0x12}).add<std::uint16_t>({0x4D10, 0x1234});
    configuration.add(std::uint32_t{99}).add(std::uint16_t{7});
    configuration.add<std::int32_t>({screen_width_um, screen_height_um});
    Bytes status;
    status.add(std::uint8_t{0x13}).add(std::uint8_t{1}).add(hz);
    return {{0x11, capabilities.bytes()}, {0x12, configuration.bytes()}, {0x13, status.bytes()}};
}

TEST(EyeTracker, FeaturesAreReadByUsage) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    const TrackerFeatures features = decode_features(layout, features_in_um(1.0));
    EXPECT_EQ(features.quality, 2U);
    EXPECT_DOUBLE_EQ(*features.minimum_distance_m, 0.45);
    EXPECT_DOUBLE_EQ(*features.maximum_width_m, 0.6);
    EXPECT_DOUBLE_EQ(*features.maximum_height_m, 0.34);
    EXPECT_DOUBLE_EQ(features.capability_correction, 1.0);
    EXPECT_EQ(features.display_manufacturer, 0x4D10U);
    EXPECT_EQ(features.display_serial, 99U);
    EXPECT_DOUBLE_EQ(*features.screen_width_m, 0.52704);
    EXPECT_DOUBLE_EQ(*features.screen_height_m, 0.29646);
    EXPECT_EQ(features.status, (StatusReport{TrackerStatus::Ready, 90}));
}

TEST(EyeTracker, CapabilitiesOffByAThousandAreCorrectedAndSaidSo) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    const TrackerFeatures small = decode_features(layout, features_in_um(1e-3));
    EXPECT_DOUBLE_EQ(*small.optimum_distance_m, 0.65);
    EXPECT_DOUBLE_EQ(small.capability_correction, 1000.0);
    const TrackerFeatures large = decode_features(layout, features_in_um(1e3));
    EXPECT_NEAR(*large.optimum_distance_m, 0.65, 1e-9);
    EXPECT_DOUBLE_EQ(large.capability_correction, 1e-3);
    const TrackerFeatures absurd = decode_features(layout, features_in_um(1e-5));
    EXPECT_FALSE(absurd.optimum_distance_m.has_value());
    EXPECT_EQ(absurd.implausible.size(), 5U) << "each is told";
}

// The edge of a screen is a place.
TEST(ReportValue, HasTheGreatestNumberOfAPlaceWhereItsRangeHasIt) {
    const std::vector<std::uint8_t> ones{0xFF, 0xFF, 0xFF, 0xFF};
    const auto number = [&](std::uint32_t bits, std::int64_t least, std::int64_t greatest,
                            Quantity quantity = Quantity::Length) {
        ReportField field;
        field.bits = bits;
        field.logical_minimum = least;
        field.logical_maximum = greatest;
        return value_of(field, 0, quantity, false)->number(ones);
    };
    EXPECT_EQ(number(16, 0, 65535), 65535);
    EXPECT_EQ(number(16, 0, 65534), std::nullopt);
    EXPECT_EQ(number(16, 0, 0), std::nullopt) << "no range was given";
    EXPECT_EQ(number(12, 0, 4095), 4095);
    EXPECT_EQ(number(32, 0, 0xFFFFFFFF), std::nullopt);
    EXPECT_EQ(number(16, -32768, 32767), -1);
    EXPECT_EQ(number(16, 0, 65535, Quantity::Count), std::nullopt) << "no count";
}

// One that cannot be, or is no data, does not take the others with it.
TEST(EyeTracker, CapabilitiesAreJudgedEachByItself) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    std::vector<FeatureReport> reports = features_in_um(1.0);
    const auto set_minimum = [&](std::int32_t um) {
        std::memcpy(&reports[0].bytes[2], &um, sizeof(um));
        return decode_features(layout, reports);
    };
    const TrackerFeatures no_data = set_minimum(kNoData);
    EXPECT_FALSE(no_data.minimum_distance_m.has_value());
    EXPECT_DOUBLE_EQ(*no_data.optimum_distance_m, 0.65);
    EXPECT_TRUE(no_data.implausible.empty()) << "no data is no fault";
    const TrackerFeatures far = set_minimum(100'000'000);
    EXPECT_FALSE(far.minimum_distance_m.has_value());
    EXPECT_DOUBLE_EQ(*far.optimum_distance_m, 0.65);
    EXPECT_DOUBLE_EQ(*far.maximum_height_m, 0.34);
    EXPECT_DOUBLE_EQ(far.capability_correction, 1.0);
    ASSERT_EQ(far.implausible.size(), 1U);
    EXPECT_EQ(far.implausible[0].of, "its least distance");
    EXPECT_DOUBLE_EQ(far.implausible[0].metres, 100.0);
}

TEST(EyeTracker, TheScreenIsHeldAgainstTheSameRange) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    const auto with_screen = [&](std::int32_t width_um, std::int32_t height_um) {
        return decode_features(layout, features_in_um(1.0, width_um, height_um));
    };
    const TrackerFeatures no_data = with_screen(kNoData, kNoData);
    EXPECT_FALSE(no_data.screen_width_m || no_data.screen_height_m);
    const TrackerFeatures small = with_screen(527, 296);
    EXPECT_NEAR(*small.screen_width_m, 0.527, 1e-12);
    EXPECT_NEAR(*small.screen_height_m, 0.296, 1e-12);
    EXPECT_DOUBLE_EQ(small.screen_correction, 1e3);
    EXPECT_DOUBLE_EQ(small.capability_correction, 1.0);
    const TrackerFeatures large = with_screen(527'000'000, 296'000'000);
    EXPECT_NEAR(*large.screen_width_m, 0.527, 1e-12);
    EXPECT_DOUBLE_EQ(large.screen_correction, 1e-3);
    const TrackerFeatures odd = with_screen(527'000, 2'147'483'646);
    EXPECT_DOUBLE_EQ(*odd.screen_width_m, 0.527);
    EXPECT_FALSE(odd.screen_height_m.has_value());
    ASSERT_EQ(odd.implausible.size(), 1U);
    EXPECT_EQ(odd.implausible[0].of, "its screen's height");
}

TEST(EyeTracker, CountsOfZeroAndWithoutDataAreNotStated) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    for (const std::uint16_t hz : {std::uint16_t{0}, std::uint16_t{0xFFFF}}) {
        const auto reports = features_in_um(1.0, 527'040, 296'460, hz);
        EXPECT_EQ(decode_features(layout, reports).status,
                  (StatusReport{TrackerStatus::Ready, std::nullopt}));
        EXPECT_EQ(std::get<StatusReport>(decode_input(layout, reports[2].bytes)),
                  (StatusReport{TrackerStatus::Ready, std::nullopt}));
    }
    std::vector<FeatureReport> none = features_in_um(1.0);
    for (const std::uint8_t byte : {std::uint8_t{0}, std::uint8_t{0xFF}}) {
        std::fill_n(none[1].bytes.begin() + 1, 10, byte);
        const TrackerFeatures features = decode_features(layout, none);
        EXPECT_FALSE(features.display_manufacturer || features.display_product ||
                     features.display_serial);
    }
}

TEST(EyeTracker, FeaturesThatCouldNotBeReadAreAbsent) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    const TrackerFeatures none = decode_features(layout, {});
    EXPECT_FALSE(none.maximum_width_m || none.screen_width_m || none.status.status);
    const std::vector<FeatureReport> cut{{0x12, {0x12, 1, 2}}, {0x11, {}}};
    const TrackerFeatures some = decode_features(layout, cut);
    EXPECT_EQ(some.display_manufacturer, 0x0201U);
    EXPECT_FALSE(some.display_product || some.screen_width_m || some.maximum_width_m);
}

TEST(EyeTracker, ModesAreAskedForInTheControlReport) {
    const EyeTrackerLayout layout = layout_of(first_layout());
    EXPECT_EQ(encode_mode_request(layout, kModeGaze | kModeEyePosition),
              (std::vector<std::uint8_t>{0x14, 3}));
    EXPECT_EQ(encode_mode_request(layout, kModeStop), (std::vector<std::uint8_t>{0x14, 0}));
}

TEST(ScreenGaze, RaysGoFromEachEyeToThePoint) {
    const TrackingReport report = tracking(layout_of(first_layout()), first_report().bytes());
    const gaze::PerEye<gaze::EyeRay> rays = eye_rays(report, {});
    ASSERT_TRUE(rays[0].valid && rays[1].valid);
    expect_near(rays[0].origin_m, {-0.03, 0.0, 0.0});
    expect_near(rays[1].origin_m, {0.03, 0.0, 0.0});
    // Left eye at (170, 160), gaze at (200, 100): right by 30 and up by 60 at 600 mm.
    expect_near(rays[0].direction, glm::normalize(glm::dvec3{0.03, 0.06, -0.6}));
    expect_near(rays[1].direction, glm::normalize(glm::dvec3{-0.03, 0.06, -0.6}));
}

TEST(ScreenGaze, OneKnownEyeIsTheOnlyValidOne) {
    const TrackingReport report =
        tracking(layout_of(first_layout()), first_report(200'000, kNoData).bytes());
    const gaze::PerEye<gaze::EyeRay> rays = eye_rays(report, {0.5, 0.3, 0.7, 0.064});
    EXPECT_TRUE(rays[0].valid);
    EXPECT_FALSE(rays[1].valid);
    expect_near(rays[0].origin_m, {-0.032, 0.0, 0.0});
}

TEST(ScreenGaze, WithoutEyesTheGeometryTakesTheirPlace) {
    TrackingReport report;
    report.gaze_m = {0.25, 0.15};  // the middle of the screen
    const ScreenGeometry geometry{0.5, 0.3, 0.6, 0.06};
    const gaze::PerEye<gaze::EyeRay> rays = eye_rays(report, geometry);
    ASSERT_TRUE(rays[0].valid && rays[1].valid);
    expect_near(rays[0].origin_m, {-0.03, 0.0, 0.0});
    expect_near(rays[0].direction, glm::normalize(glm::dvec3{0.03, 0.0, -0.6}));
    EXPECT_FALSE(eye_rays(report, {0.5, 0.3, 0.0, 0.06})[0].valid) << "how far away is unknown";
    report.gaze_m = {0.0, 0.0};  // top left
    const gaze::EyeRay corner = eye_rays(report, geometry)[0];
    EXPECT_LT(corner.direction.x, 0.0);
    EXPECT_GT(corner.direction.y, 0.0);
}

TEST(ScreenGaze, EyesBehindTheScreenAndReportsWithoutGazeAreInvalid) {
    TrackingReport report;
    report.gaze_m = {0.1, 0.1};
    report.eye_m = {glm::dvec3{0.1, 0.1, 0.0}, glm::dvec3{0.1, 0.1, -0.5}};
    for (const gaze::EyeRay& ray : eye_rays(report, {})) {
        EXPECT_FALSE(ray.valid);
        EXPECT_TRUE(std::isfinite(ray.direction.x));
    }
    report.gaze_m.reset();
    report.eye_m = {glm::dvec3{0.1, 0.1, 0.6}, glm::dvec3{0.2, 0.1, 0.6}};
    EXPECT_FALSE(eye_rays(report, {0.5, 0.3, 0.6})[0].valid);
}

TEST(ScreenGaze, SaysWhichGeometryIsMissing) {
    EXPECT_FALSE(geometry_problem(layout_of(first_layout()), {}).has_value());
    const EyeTrackerLayout blind = layout_of(second_layout(false));
    const std::string all = geometry_problem(blind, {}).value_or("");
    EXPECT_NE(all.find("hid.viewing_distance_m"), std::string::npos);
    EXPECT_NE(all.find("hid.screen_width_m"), std::string::npos);
    const std::string distance = geometry_problem(blind, {0.5, 0.3}).value_or("");
    EXPECT_NE(distance.find("hid.viewing_distance_m"), std::string::npos);
    EXPECT_EQ(distance.find("hid.screen_width_m"), std::string::npos);
    EXPECT_FALSE(geometry_problem(blind, {0.5, 0.3, 0.6}).has_value());
}

}  // namespace
}  // namespace gazeloop::drivers::hid
