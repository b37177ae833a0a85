#pragma once

#include <cpl_error.h>
#include <gdal.h>

#include <memory>
#include <string>

namespace belvedere {

// What the files of this folder share, the only one of the project that knows GDAL. Nothing outside of it includes this header.

// The other side of http_access.h: names of addresses as GDAL has them and back (empty: none), its settings for this thread, a warning that
// may say that a try is repeated, and a failure in a user's words.
std::string address_to_gdal(const std::string& address);
std::string address_from_gdal(const std::string& path);
void set_http_of_thread();
void tell_http_retry(const char* text);
std::string explain_http(const std::string& problem);

// While it lives, GDAL prints nothing in this thread, and the first failure it reports is kept in its own words.
class GdalErrors {
 public:
  GdalErrors() {
    CPLErrorReset();
    CPLPushErrorHandlerEx(&GdalErrors::collect, this);
  }
  ~GdalErrors() { CPLPopErrorHandler(); }
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  bool failed() const { return failed_; }
  // GDAL's words after what we were doing, such as "cannot be read: TIFFFillStrip: Read error …".
  std::string say(const std::string& doing) const { return text_.empty() ? doing : doing + ": " + text_; }

 private:
  static void CPL_STDCALL collect(CPLErr severity, CPLErrorNum, const char* text) {
    auto* errors = static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
    if (severity == CE_Warning) tell_http_retry(text);
    if (severity < CE_Failure || errors->failed_) return;  // debug messages and warnings
    errors->failed_ = true;
    errors->text_ = text;
  }

  bool failed_ = false;
  std::string text_;
};

// Makes GDAL's formats known, once a process, and holds its cache of blocks to a sixteenth of memory_budget_bytes(), which may have changed
// since: to be called before a file is opened.
void register_gdal();

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

}  // namespace belvedere
