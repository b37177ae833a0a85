#pragma once

#include <cpl_error.h>
#include <gdal.h>

#include <memory>
#include <string>

namespace belvedere {

// Shared by the files of this folder, the only one of the project that uses GDAL. Nothing outside
// includes this header.

// GDAL's side of http_access.h: conversion of addresses to GDAL's names and back (empty: not an
// address), its settings for this thread, detection of retry warnings, and failures in plain words.
std::string address_to_gdal(const std::string& address);
std::string address_from_gdal(const std::string& path);
void set_http_of_thread();
void tell_http_retry(const char* text);
std::string explain_http(const std::string& problem);

// While it lives, GDAL prints nothing in this thread, and the first failure it reports is kept.
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
  // GDAL's message after what failed, such as "cannot read the file: TIFFFillStrip: Read error …".
  std::string say(const std::string& doing) const {
    return text_.empty() ? doing : doing + ": " + text_;
  }

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

// Registers GDAL's formats, once per process, and limits its block cache to a sixteenth of
// memory_budget_bytes(), which may have changed: call it before opening a file.
void register_gdal();

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

}  // namespace belvedere
