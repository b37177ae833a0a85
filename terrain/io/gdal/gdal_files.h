#pragma once

#include <cpl_error.h>
#include <gdal.h>

#include <memory>
#include <string>
#include <vector>

#include "base/files/output_file.h"

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

// While it lives, GDAL prints nothing in this thread, and the first failure it reports is kept, or
// warning of data that it leaves out.
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
  bool lost() const { return lost_; }  // a warning of data left out
  // GDAL's message after what failed, such as "cannot read the file: TIFFFillStrip: Read error …".
  std::string say(const std::string& doing) const {
    return text_.empty() ? doing : doing + ": " + text_;
  }

 private:
  static bool is_loss(const char* warning);
  static void CPL_STDCALL collect(CPLErr severity, CPLErrorNum, const char* text) {
    auto* errors = static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
    if (severity == CE_Warning) tell_http_retry(text);
    const bool lost = severity == CE_Warning && is_loss(text);
    errors->lost_ = errors->lost_ || lost;
    if ((severity < CE_Failure && !lost) || errors->failed_) return;
    errors->failed_ = true;
    errors->text_ = text;
  }

  bool failed_ = false;
  bool lost_ = false;
  std::string text_;
};

// Registers GDAL's formats, once per process, and limits its block cache to a sixteenth of
// memory_budget_bytes(), which may have changed: call it before opening a file.
void register_gdal();

struct CloseDataset {
  // The private copy of a database that has changes beside it, removed after the dataset is closed.
  std::shared_ptr<const ScratchFolder> copy = {};
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

// SQLite keeps the last changes of a database (GeoPackage) in a file beside it, "-wal" or
// "-journal", until a program writes them into it: they are part of the data. Paths of those with
// content, beside the file itself if `path` is a link to it.
std::vector<std::string> database_changes(const std::string& path);
// Whether a database is in the mode in which even reading makes files beside it, or has changes
// beside it.
bool is_database_in_use(const std::string& path);

// All inputs are opened here. GDAL's name of a file or of something in it ("GPKG:a.gpkg:dem") is
// opened for reading; nothing beside the file is written or removed: a database with changes is
// read from a private copy, in which they are made, one without is opened as immutable. Null and
// `errors` if GDAL cannot open it; Error(input) at `path` if it leaves data out, or the database is
// being changed or cannot be copied. `whole`: the file that the dataset is part of.
Dataset open_to_read(const std::string& name, const std::string& path, unsigned kind,
                     const char* const* drivers, const GdalErrors& errors,
                     const char* const* options = nullptr, const Dataset& whole = {});

}  // namespace belvedere
