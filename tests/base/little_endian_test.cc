#include "base/little_endian.h"

#include <gtest/gtest.h>

#include <string>

namespace pleinair {
namespace {

TEST(LittleEndian, PutsTheLeastSignificantByteFirst) {
  std::string bytes;
  PutLittleEndian(std::uint32_t{0x01020384}, &bytes);
  PutLittleEndian(std::int16_t{-2}, &bytes);
  PutLittleEndian(1.0, &bytes);  // IEEE 754: 0x3FF0000000000000.
  PutLittleEndian(-2.0F, &bytes);
  EXPECT_EQ(bytes,
            std::string("\x84\x03\x02\x01\xFE\xFF\0\0\0\0\0\0\xF0\x3F\0\0\0\xC0", 4 + 2 + 8 + 4));
}

TEST(LittleEndian, ReadsWhatWasPut) {
  std::string bytes;
  PutLittleEndian(std::uint64_t{0xFFFFFFFFFFFFFFFE}, &bytes);
  PutLittleEndian(std::int8_t{-128}, &bytes);
  PutLittleEndian(-1.5e-300, &bytes);
  PutLittleEndian(0.1F, &bytes);
  LittleEndianReader reader(bytes);
  EXPECT_EQ(reader.Get<std::uint64_t>(), 0xFFFFFFFFFFFFFFFE);
  EXPECT_EQ(reader.Get<std::int8_t>(), -128);
  EXPECT_EQ(reader.Get<double>(), -1.5e-300);
  EXPECT_EQ(reader.Get<float>(), 0.1F);
  EXPECT_TRUE(reader.complete());
  EXPECT_TRUE(reader.rest().empty());
}

TEST(LittleEndian, GivesNothingOnceBytesAreMissing) {
  LittleEndianReader reader("abc");
  EXPECT_EQ(reader.Get<std::uint32_t>(), 0U);
  EXPECT_FALSE(reader.complete());
  // Reads nothing further, even if it would fit: the position is undefined.
  EXPECT_EQ(reader.Take(1), "");
  EXPECT_FALSE(reader.complete());
  LittleEndianReader whole("abc");
  EXPECT_EQ(whole.Take(2), "ab");
  EXPECT_EQ(whole.rest(), "c");
  EXPECT_EQ(whole.Take(std::string_view::npos), "");
  EXPECT_FALSE(whole.complete());
}

}  // namespace
}  // namespace pleinair
