#pragma once

#include <lcms2.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "renderer/image/icc/device_parameters.h"

// Owners of lcms2 objects; private to this folder, the only one that uses the library.
namespace belvedere::icc {

// Its own context keeps messages apart from other threads.
class Context {
 public:
  Context();
  ~Context() { cmsDeleteContext(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator cmsContext() const { return context_; }
  const std::string& message() const { return message_; }

 private:
  std::string message_;
  cmsContext context_;
};

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, CloseProfile>;
struct DeleteTransform {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
using Transform = std::unique_ptr<void, DeleteTransform>;

// Null where the bytes are not a profile.
Profile open_profile(const Context& context, const std::vector<std::uint8_t>& bytes);
// A profile made by lcms2, as the same bytes every time: with a fixed date, a name, and its own
// checksum.
std::vector<std::uint8_t> save_dated(const Context& context, Profile profile, const char* name);
// Its description, for messages.
std::string name_of(const Profile& profile);
// Class and colours as its header has them. Numbers, since damaged files hold some that are no
// enumerator.
std::uint32_t class_of(const Profile& profile);
std::uint32_t colours_of(const Profile& profile);
// The bytes of a file; Error(input) where it is missing, cannot be read or is far too large.
std::vector<std::uint8_t> read_profile_bytes(const std::string& path);
// Error(input) unless it is an open profile of a device or space with these colours, that pictures
// can be converted to. `allowed`: describes suitable profiles.
void require_device(const std::string& where, const Context& context, const Profile& profile,
                    cmsColorSpaceSignature space, const char* allowed);
// A conversion with the same bits for any number of threads and any split of a picture.
// Error(input) where the profiles cannot be joined.
Transform make_transform(const Context& context, const Profile& from, cmsUInt32Number from_type,
                         const Profile& to, cmsUInt32Number to_type,
                         const DeviceParameters& parameters);

}  // namespace belvedere::icc
