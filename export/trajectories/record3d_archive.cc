#include "export/trajectories/record3d_archive.h"

#include <zip.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include "files/text_file.h"

namespace pleinair::exports {
namespace {

constexpr const char* kMember = "metadata";
constexpr const char* kShareAgain = "share it again from Record3D";
/// Numbers in JSON compress three- to tenfold, DEFLATE a thousandfold at most.
constexpr zip_uint64_t kMaxRatio = 100, kSurelySmall = zip_uint64_t{1} << 20;

struct CloseMember {
  void operator()(zip_file_t* member) const { zip_fclose(member); }
};
/// An archive that is only read has nothing to write.
struct DiscardArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, DiscardArchive>;

/// The error of libzip as one of the file's.
tl::unexpected<Error> ArchiveError(const std::string& name, const zip_error_t& error) {
  if (zip_error_system_type(&error) == ZIP_ET_SYS) {
    return InputError(
        name, "cannot be read: " + std::generic_category().message(zip_error_code_system(&error)));
  }
  if (zip_error_code_zip(&error) == ZIP_ER_MEMORY) {
    return SystemError(name, "needs more memory than there is", kShareAgain);
  }
  return InputError(name, "is no whole zip archive, as an .r3d of Record3D is", kShareAgain);
}

Result<Archive> OpenArchive(zip_source_t* source, const std::string& name) {
  zip_error_t error;
  zip_error_init(&error);
  Archive archive(zip_open_from_source(source, ZIP_RDONLY, &error));
  if (archive) return archive;
  zip_source_free(source);
  return ArchiveError(name, error);
}

/// Size of the member, bytes.
Result<zip_uint64_t> CheckedSize(zip_t* archive, zip_uint64_t index, const std::string& name) {
  constexpr zip_uint64_t kWanted = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
  zip_stat_t facts;
  if (zip_stat_index(archive, index, 0, &facts) != 0 || (facts.valid & kWanted) != kWanted) {
    return ArchiveError(name, *zip_get_error(archive));
  }
  if ((facts.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && facts.encryption_method != ZIP_EM_NONE) {
    return InputError(name, "is encrypted", "share it without a password");
  }
  if (facts.size > kMaxRecord3dMetadata_bytes ||
      (facts.size > kSurelySmall && facts.size / kMaxRatio > facts.comp_size)) {
    return InputError(name, "has metadata that would unpack to more than a trajectory needs",
                      kShareAgain);
  }
  return facts.size;
}

Result<std::string> MetadataIn(zip_t* archive, const std::string& name) {
  const zip_int64_t found = zip_name_locate(archive, kMember, 0);
  if (found < 0) {
    return InputError(name, "is an archive without metadata, so none of Record3D",
                      "name the .r3d that Record3D shares");
  }
  const auto index = static_cast<zip_uint64_t>(found);
  PLEINAIR_ASSIGN_OR_RETURN(const zip_uint64_t size, CheckedSize(archive, index, name));
  const std::unique_ptr<zip_file_t, CloseMember> member(zip_fopen_index(archive, index, 0));
  if (!member) return ArchiveError(name, *zip_get_error(archive));
  std::string text(static_cast<std::size_t>(size), '\0');
  zip_uint64_t done = 0;
  while (done < size) {
    const zip_int64_t got = zip_fread(member.get(), text.data() + done, size - done);
    if (got <= 0) return ArchiveError(name, *zip_file_get_error(member.get()));
    done += static_cast<zip_uint64_t>(got);
  }
  // The checksum is compared where the data end.
  char more = 0;
  if (zip_fread(member.get(), &more, 1) != 0) {
    return ArchiveError(name, *zip_file_get_error(member.get()));
  }
  return text;
}

}  // namespace

bool IsZipArchive(const std::filesystem::path& file) {
  if (!files::CheckRegularFile(file)) return false;  // Opening a pipe waits for its writer.
  std::array<char, 2> start{};
  std::ifstream in(file, std::ios::binary);
  return in.read(start.data(), start.size()) && start == std::array{'P', 'K'};
}

Result<std::string> ReadRecord3dArchive(const std::filesystem::path& file) {
  const std::string name = file.string();
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_file_create(name.c_str(), 0, -1, &error);
  if (source == nullptr) return ArchiveError(name, error);
  PLEINAIR_ASSIGN_OR_RETURN(const Archive archive, OpenArchive(source, name));
  return MetadataIn(archive.get(), name);
}

Result<std::string> ParseRecord3dArchive(std::string_view bytes, const std::string& name) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source == nullptr) return ArchiveError(name, error);
  PLEINAIR_ASSIGN_OR_RETURN(const Archive archive, OpenArchive(source, name));
  return MetadataIn(archive.get(), name);
}

}  // namespace pleinair::exports
