#include "accuracy/random.h"

#include "accuracy/normal_quantile.h"

namespace pleinair::accuracy {
namespace {

// Salmon et al. 2011, section 3.3 and table 2: multipliers and Weyl increments of Philox4x32.
constexpr std::uint32_t kMultiplier0 = 0xD2511F53, kMultiplier1 = 0xCD9E8D57;
constexpr std::uint32_t kWeyl0 = 0x9E3779B9, kWeyl1 = 0xBB67AE85;
constexpr int kRounds = 10;

/// FNV-1a, 64 bits (Fowler, Noll & Vo).
std::uint64_t HashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

constexpr std::uint32_t Low(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
constexpr std::uint32_t High(std::uint64_t value) {
  return static_cast<std::uint32_t>(value >> 32);
}

}  // namespace

std::array<std::uint32_t, 4> Philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t product0 = std::uint64_t{kMultiplier0} * counter[0];
    const std::uint64_t product1 = std::uint64_t{kMultiplier1} * counter[2];
    counter = {High(product1) ^ counter[1] ^ key[0], Low(product1),
               High(product0) ^ counter[3] ^ key[1], Low(product0)};
    key[0] += kWeyl0;
    key[1] += kWeyl1;
  }
  return counter;
}

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose)
    : key_{Low(seed), High(seed)} {
  const std::uint64_t stream = HashOf(purpose);
  counter_ = {0, 0, Low(stream), High(stream)};
}

std::uint32_t RandomStream::Word() {
  if (used_ == 4) {
    block_ = Philox(counter_, key_);
    used_ = 0;
    if (++counter_[0] == 0) ++counter_[1];
  }
  return block_[used_++];
}

double RandomStream::Uniform() {
  const std::uint64_t high = Word() >> 5, low = Word() >> 6;  // 27 and 26 bits.
  return static_cast<double>((high << 26) | low) * 0x1p-53;
}

double RandomStream::Uniform(double low, double high) { return low + (high - low) * Uniform(); }

int RandomStream::Below(int count) {
  return static_cast<int>((static_cast<std::uint64_t>(Word()) * static_cast<unsigned>(count)) >>
                          32);
}

double RandomStream::Normal() { return NormalQuantile(Uniform() + 0x1p-54); }

float RandomStream::NormalFromWord() {
  return static_cast<float>(NormalQuantile((static_cast<double>(Word()) + 0.5) * 0x1p-32));
}

}  // namespace pleinair::accuracy
