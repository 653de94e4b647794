#include "drivers/hid/report_descriptor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "tests/unit/drivers/hid/descriptor_items.h"

namespace gazeloop::drivers::hid {
namespace {

using Items = DescriptorItems;

ReportDescriptor parse(const Items& items) {
    return value_or_throw(parse_report_descriptor(items.bytes()));
}

std::string refusal(const Items& items) {
    const auto parsed = parse_report_descriptor(items.bytes());
    EXPECT_FALSE(parsed.has_value());
    if (parsed) {
        return "";
    }
    EXPECT_EQ(parsed.error().kind, ErrorKind::BadInput);
    return parsed.error().message;
}

/// The boot mouse of HID 1.11, appendix B.2: three buttons, padding, two signed bytes.
TEST(ReportDescriptor, ReadsTheStandardsOwnMouse) {
    Items items;
    items.raw({0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0x09, 0x01, 0xA1, 0x00, 0x05, 0x09, 0x19,
               0x01, 0x29, 0x03, 0x15, 0x00, 0x25, 0x01, 0x95, 0x03, 0x75, 0x01, 0x81, 0x02,
               0x95, 0x01, 0x75, 0x05, 0x81, 0x01, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15,
               0x81, 0x25, 0x7F, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0xC0, 0xC0});
    const ReportDescriptor mouse = parse(items);
    EXPECT_FALSE(mouse.numbered);
    ASSERT_EQ(mouse.collections.size(), 2U);
    EXPECT_EQ(mouse.collections[0].usage, usage(1, 2));
    EXPECT_EQ(mouse.collections[0].type, 1);
    EXPECT_EQ(mouse.collections[1].parent, 0U);
    ASSERT_EQ(mouse.fields.size(), 3U);
    EXPECT_EQ(mouse.fields[0].usage_of(0), usage(9, 1));
    EXPECT_EQ(mouse.fields[0].usage_of(2), usage(9, 3));
    EXPECT_EQ(mouse.fields[0].flags, 2U) << "variable";
    EXPECT_EQ(mouse.fields[1].flags & 1U, 1U) << "constant";
    EXPECT_EQ(mouse.fields[1].bit_offset, 3U);
    EXPECT_EQ(mouse.fields[2].bit_offset, 8U);
    EXPECT_EQ(mouse.fields[2].usage_of(1), usage(1, 0x31));
    EXPECT_EQ(mouse.fields[2].logical_minimum, -127);
    EXPECT_EQ(mouse.fields[2].logical_maximum, 127);
    ASSERT_NE(find_report(mouse.reports, ReportKind::Input, 0), nullptr);
    EXPECT_EQ(find_report(mouse.reports, ReportKind::Input, 0)->bits, 24U);
}

TEST(ReportDescriptor, RangesAreSignedWhereTheMinimumIsNegative) {
    Items items;
    items.raw({0x15, 0x00, 0x25, 0xFF}).fields(8, 1).input(0);  // 0 .. 255
    items.raw({0x15, 0x80, 0x25, 0x7F}).input(0);               // -128 .. 127
    items.raw({0x16, 0x00, 0x80, 0x26, 0xFF, 0xFF}).input(0);   // -32768 .. -1
    items.raw({0x25, 0xFE, 0x15, 0xFD}).input(0);               // the maximum first: -3 .. -2
    items.raw({0x17, 0, 0, 0, 0, 0x27, 0xFF, 0xFF, 0xFF, 0xFF}).input(0);
    items.raw({0x14, 0x24}).input(0);  // no data at all: 0 .. 0
    const ReportDescriptor parsed = parse(items);
    ASSERT_EQ(parsed.fields.size(), 6U);
    const auto expect = [&](std::size_t field, std::int64_t least, std::int64_t greatest) {
        EXPECT_EQ(parsed.fields[field].logical_minimum, least) << field;
        EXPECT_EQ(parsed.fields[field].logical_maximum, greatest) << field;
    };
    expect(0, 0, 255);
    expect(1, -128, 127);
    expect(2, -32768, -1);
    expect(3, -3, -2);
    expect(4, 0, 4294967295);
    expect(5, 0, 0);
}

TEST(ReportDescriptor, ExponentsAreNibblesOrWholeBytes) {
    Items items;
    items.fields(8, 1);
    for (const std::uint32_t nibble : {0x0U, 0x7U, 0x8U, 0xCU, 0xFU, 0xFDU}) {
        items.exponent(nibble).input(0);
    }
    const ReportDescriptor parsed = parse(items);
    std::vector<int> exponents;
    std::ranges::transform(parsed.fields, std::back_inserter(exponents),
                           &ReportField::unit_exponent);
    EXPECT_EQ(exponents, (std::vector<int>{0, 7, -8, -4, -1, -3}));
}

TEST(ReportDescriptor, PushAndPopKeepEveryGlobalItem) {
    Items items;
    items.page(0x12).logical(-5, 5).physical(-7, 7).exponent(3).unit(0x11).fields(16, 2);
    items.report_id(9).item(0xA4, 0, 0);
    items.page(1).logical(0, 1).physical(0, 2).exponent(1).unit(0x1001).fields(8, 1).report_id(4);
    items.usage(7).input(0);
    items.item(0xB4, 0, 0).usage(8).input(0);
    const ReportDescriptor parsed = parse(items);
    ASSERT_EQ(parsed.fields.size(), 2U);
    const ReportField& inner = parsed.fields[0];
    EXPECT_EQ(inner.usage_of(0), usage(1, 7));
    EXPECT_EQ(inner.report_id, 4);
    const ReportField& outer = parsed.fields[1];
    EXPECT_EQ(outer.usage_of(0), usage(0x12, 8));
    EXPECT_EQ(outer.report_id, 9);
    EXPECT_EQ(outer.bits, 16U);
    EXPECT_EQ(outer.count, 2U);
    EXPECT_EQ(outer.logical_minimum, -5);
    EXPECT_EQ(outer.physical_maximum, 7);
    EXPECT_EQ(outer.unit_exponent, 3);
    EXPECT_EQ(outer.unit, 0x11U);
}

TEST(ReportDescriptor, OffsetsCountForEachReportAndKindApart) {
    Items items;
    items.fields(8, 1).report_id(1).input(0).feature(0).report_id(2).input(0);
    items.report_id(1).fields(4, 3).input(0).output(0).input(0);
    const ReportDescriptor parsed = parse(items);
    ASSERT_EQ(parsed.fields.size(), 6U);
    EXPECT_EQ(parsed.fields[2].bit_offset, 0U);
    EXPECT_EQ(parsed.fields[3].bit_offset, 8U);
    EXPECT_EQ(parsed.fields[4].bit_offset, 0U);
    EXPECT_EQ(parsed.fields[5].bit_offset, 20U);
    EXPECT_EQ(find_report(parsed.reports, ReportKind::Input, 1)->bits, 32U);
    EXPECT_EQ(find_report(parsed.reports, ReportKind::Input, 1)->payload_bytes(), 4U);
    EXPECT_EQ(find_report(parsed.reports, ReportKind::Output, 1)->payload_bytes(), 2U);
    EXPECT_EQ(find_report(parsed.reports, ReportKind::Feature, 2), nullptr);
    EXPECT_TRUE(parsed.numbered);
}

TEST(ReportDescriptor, UsagesTakeThePageAtTheMainItemUnlessTheyBringOne) {
    Items items;
    items.fields(8, 4).page(1).usage(5);
    items.item(0x08, 4, usage(0x12, 0x20));                    // with a page of its own
    items.item(0x18, 1, 0x30).item(0x28, 1, 0x31).page(0x0C);  // a range, then another page
    items.input(0);
    const ReportDescriptor parsed = parse(items);
    const ReportField& field = parsed.fields[0];
    EXPECT_EQ(field.usage_of(0), usage(0x0C, 5));
    EXPECT_EQ(field.usage_of(1), usage(0x12, 0x20));
    EXPECT_EQ(field.usage_of(2), usage(0x0C, 0x30));
    EXPECT_EQ(field.usage_of(3), usage(0x0C, 0x31));
    EXPECT_EQ(field.usage_of(4000), usage(0x0C, 0x31)) << "the last one serves the rest";
}

TEST(ReportDescriptor, LocalItemsEndWithTheMainItem) {
    Items items;
    items.fields(8, 1).page(1).usage(5).input(0).input(0);
    items.open(CollectionType::Logical, 6).input(0).close();
    const ReportDescriptor parsed = parse(items);
    EXPECT_EQ(parsed.fields[0].usage_of(0), usage(1, 5));
    EXPECT_TRUE(parsed.fields[1].usages.empty());
    EXPECT_EQ(parsed.fields[1].usage_of(0), 0U);
    EXPECT_TRUE(parsed.fields[2].usages.empty());
    EXPECT_TRUE(parsed.inside(parsed.fields[2], usage(1, 6)));
    EXPECT_FALSE(parsed.inside(parsed.fields[1], usage(1, 6)));
}

TEST(ReportDescriptor, OfDelimitedUsagesTheFirstCounts) {
    Items items;
    items.fields(8, 2).page(1).item(0xA8, 1, 1).usage(5).usage(6).item(0xA8, 1, 0).usage(7);
    items.input(0);
    const ReportDescriptor parsed = parse(items);
    EXPECT_EQ(parsed.fields[0].usage_of(0), usage(1, 5));
    EXPECT_EQ(parsed.fields[0].usage_of(1), usage(1, 7));
}

TEST(ReportDescriptor, SkipsLongItemsAndReservedTags) {
    Items items;
    items.raw({0xFE, 3, 0xF0, 0x81, 0x81, 0x81});  // its data look like Inputs
    items.raw({0xFE, 0, 0xF0}).item(0x0C, 1, 3).item(0xF4, 1, 3).item(0xF8, 1, 3);
    items.item(0xF0, 1, 3).fields(8, 1).input(0);
    EXPECT_EQ(parse(items).fields.size(), 1U);
}

TEST(ReportDescriptor, AHugeUsageRangeTakesNoMemory) {
    Items items;
    items.fields(8, 3).item(0x18, 4, 0).item(0x28, 4, 0xFFFFFFFF).usage(1).input(0);
    const ReportDescriptor parsed = parse(items);
    EXPECT_EQ(parsed.fields[0].usages.size(), 2U);
    EXPECT_EQ(parsed.fields[0].usage_of(0xFFFFFFFF), 0xFFFFFFFFU);
}

TEST(ReportDescriptor, NothingIsAnEmptyDescriptor) {
    EXPECT_TRUE(parse(Items{}).fields.empty());
    Items items;
    items.usage(1).input(2);  // no size, no count: nothing to describe
    EXPECT_TRUE(parse(items).fields.empty());
    EXPECT_TRUE(parse(items).reports.empty());
}

TEST(ReportDescriptor, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(refusal(Items{}.fields(8, 1).raw({0x07, 1, 2, 3})),
              "HID report descriptor, byte 5: the item is cut off");
    EXPECT_NE(refusal(Items{}.raw({0xFE})).find("cut off"), std::string::npos);
    EXPECT_NE(refusal(Items{}.raw({0xFE, 2, 0, 1})).find("cut off"), std::string::npos);
    EXPECT_NE(refusal(Items{}.item(0xB4, 0, 0)).find("Pop without Push"), std::string::npos);
    EXPECT_NE(refusal(Items{}.close()).find("End Collection without"), std::string::npos);
    EXPECT_NE(refusal(Items{}.open(CollectionType::Logical, 1)).find("not closed"),
              std::string::npos);
    EXPECT_NE(refusal(Items{}.report_id(0)).find("1 .. 255"), std::string::npos);
    EXPECT_NE(refusal(Items{}.item(0x84, 2, 256)).find("1 .. 255"), std::string::npos);
    EXPECT_NE(refusal(Items{}.item(0xA8, 1, 0)).find("delimiters"), std::string::npos);
    EXPECT_NE(refusal(Items{}.item(0xA8, 1, 1).input(0)).find("delimiter"), std::string::npos);
    EXPECT_NE(refusal(Items{}.item(0x74, 4, 0x10000)).find("65535 bits"), std::string::npos);
    EXPECT_NE(refusal(Items{}.item(0x94, 4, 0x10000)).find("65535"), std::string::npos);
    EXPECT_NE(refusal(Items{}.item(0x74, 2, 0xFFFF).item(0x94, 2, 0xFFFF).input(0)).find("long"),
              std::string::npos);
    Items deep;
    for (int i = 0; i < 65; ++i) {
        deep.item(0xA4, 0, 0);
    }
    EXPECT_NE(refusal(deep).find("too deep"), std::string::npos);
    Items endless;
    for (std::size_t i = 0; i <= kLongestDescriptor; ++i) {
        endless.raw({0x14});
    }
    EXPECT_NE(refusal(endless).find("4096"), std::string::npos);
}

}  // namespace
}  // namespace gazeloop::drivers::hid
