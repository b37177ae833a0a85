#include "renderer/press/print_pdf.h"

// The one file that uses qpdf, without its older pointers. Nor its JSON, whose header clang refuses
// in C++20 (a vector of a class in that class): defining its guard excludes it, and the other
// headers only need a declaration.
#define POINTERHOLDER_TRANSITION 4
#define JSON_HH
class JSON {
 public:
  class Writer;
};
#include <fmt/chrono.h>
#include <fmt/core.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <qpdf/Pl_Flate.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <qpdf/QPDFWriter.hh>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "base/text/text_encoding.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/image_io.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

using Handle = QPDFObjectHandle;

std::string points(double mm) { return fmt::format("{:.4f}", mm * points_per_mm); }
Handle box_handle(MmBox box) {
  return Handle::parse(fmt::format("[{} {} {} {}]", points(box.left), points(box.bottom),
                                   points(box.left + box.width), points(box.bottom + box.height)));
}

// The picture's numbers in the form of PDF: rows of channels, most significant byte first, each the
// difference to its left neighbour (predictor 2 of TIFF), deflated.
class PictureData final : public Handle::StreamDataProvider {
 public:
  PictureData(const PressPicture& picture, const PdfParameters& parameters, InkCount& ink,
              Progress& progress)
      : picture_(picture), bits_(parameters.bits), ink_(ink), progress_(progress) {
    if (!parameters.press.empty())
      conversion_.emplace(parameters.press, parameters.device, picture.profile);
  }

  void provideStreamData(QPDFObjGen const&, Pipeline* to) override {
    Pl_Flate deflate("picture", to, Pl_Flate::a_deflate);
    progress_.begin("writing the picture", picture_.height);
    read_picture_rows(picture_.file, [&](int, const Grid<glm::vec3>& rows) {
      if (conversion_) {
        const Grid<Inks> inks = conversion_->convert(rows);
        ink_.add(inks);
        write(inks, 4, deflate);
      } else {
        write(rows, 3, deflate);
      }
      progress_.advance(rows.height());
    });
    deflate.finish();
  }

 private:
  template <class Pixel>
  void write(const Grid<Pixel>& rows, int channels, Pipeline& to) const {
    const std::size_t row_bytes =
        static_cast<std::size_t>(rows.width()) * static_cast<std::size_t>(channels * bits_ / 8);
    std::vector<std::uint8_t> bytes(row_bytes * static_cast<std::size_t>(rows.height()));
    parallel_rows(rows.height(), [&](int y) {
      std::uint8_t* at = bytes.data() + row_bytes * static_cast<std::size_t>(y);
      for (int x = 0; x < rows.width(); ++x)
        for (int c = 0; c < channels; ++c) {
          const std::uint32_t left = x == 0 ? 0U : whole(rows(x - 1, y)[c]);
          const std::uint32_t step = whole(rows(x, y)[c]) - left;
          if (bits_ == 16) *at++ = static_cast<std::uint8_t>(step >> 8U);
          *at++ = static_cast<std::uint8_t>(step);
        }
    });
    to.write(bytes.data(), bytes.size());
  }
  std::uint32_t whole(float value) const {
    const double highest = bits_ == 16 ? 65535.0 : 255.0;
    return static_cast<std::uint32_t>(std::clamp(static_cast<double>(value), 0.0, 1.0) * highest +
                                      0.5);
  }

  const PressPicture& picture_;
  int bits_;
  InkCount& ink_;
  Progress& progress_;
  std::optional<PressConversion> conversion_;
};

// Neutral colours of drawings become grey, which a press prints in black ink alone: type in four
// inks is never quite sharp.
class NeutralToGrey final : public Handle::TokenFilter {
 public:
  void handleToken(QPDFTokenizer::Token const& token) override {
    if (token.getType() == QPDFTokenizer::tt_space ||
        token.getType() == QPDFTokenizer::tt_comment) {
      held_.push_back(token);
      return;
    }
    const bool number =
        token.getType() == QPDFTokenizer::tt_integer || token.getType() == QPDFTokenizer::tt_real;
    if (number) {
      held_.push_back(token);
      values_.push_back(token.getValue());
      return;
    }
    const bool colour = token.isWord("rg") || token.isWord("RG");
    if (colour && values_.size() == 3 && values_[0] == values_[1] && values_[1] == values_[2])
      write("\n" + values_[0] + (token.isWord("rg") ? " g" : " G"));
    else {
      flush();
      writeToken(token);
    }
    held_.clear();
    values_.clear();
  }
  void handleEOF() override { flush(); }

 private:
  void flush() {
    for (const QPDFTokenizer::Token& token : held_) writeToken(token);
    held_.clear();
  }
  std::vector<QPDFTokenizer::Token> held_;
  std::vector<std::string> values_;
};

Handle icc_space(QPDF& pdf, const std::vector<std::uint8_t>& profile, int channels) {
  Handle stream = pdf.newStream(std::string(profile.begin(), profile.end()));
  stream.getDict().replaceKey("/N", Handle::newInteger(channels));
  Handle space = Handle::newArray();
  space.appendItem(Handle::newName("/ICCBased"));
  space.appendItem(pdf.makeIndirectObject(stream));
  return space;
}

std::map<std::string, Handle> entries_of(Handle dictionary) {
  return dictionary.isDictionary() ? dictionary.getDictAsMap() : std::map<std::string, Handle>();
}

// RGB colours in drawings, and in all their parts, are sRGB; neutral ones become grey.
void settle_colours(Handle form, const Handle& srgb, std::set<QPDFObjGen>& done) {
  if (!form.isStream() || !done.insert(form.getObjGen()).second) return;
  form.addTokenFilter(std::make_shared<NeutralToGrey>());
  if (Handle group = form.getDict().getKey("/Group");
      group.isDictionary() && group.getKey("/CS").isNameAndEquals("/DeviceRGB"))
    group.replaceKey("/CS", srgb);
  Handle resources = form.getDict().getKey("/Resources");
  if (!resources.isDictionary()) return;
  if (!resources.getKey("/ColorSpace").isDictionary())
    resources.replaceKey("/ColorSpace", Handle::newDictionary());
  resources.getKey("/ColorSpace").replaceKey("/DefaultRGB", srgb);
  const auto is_form = [](Handle& one) {
    return one.isStream() && one.getDict().getKey("/Subtype").isNameAndEquals("/Form");
  };
  for (auto& [name, one] : entries_of(resources.getKey("/XObject")))
    if (is_form(one)) settle_colours(one, srgb, done);
  for (auto& [name, state] : entries_of(resources.getKey("/ExtGState")))
    if (Handle mask = state.getKey("/SMask"); mask.isDictionary())
      settle_colours(mask.getKey("/G"), srgb, done);
}

// The picture's own time, or SOURCE_DATE_EPOCH.
std::time_t time_of(const std::string& file) {
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"); epoch != nullptr && *epoch != '\0')
    return static_cast<std::time_t>(std::atoll(epoch));
  struct stat found = {};
  return ::stat(file.c_str(), &found) == 0 ? found.st_mtime : 0;
}

// XMP as required by PDF/X-4.
std::string metadata(const std::string& title, std::time_t when, bool press) {
  const std::string date = fmt::format("{:%Y-%m-%dT%H:%M:%S+00:00}", fmt::gmtime(when));
  const std::string id = hash_bytes(title + date);
  return fmt::format(
      R"(<?xpacket begin="{}" id="W5M0MpCehiHzreSzNTczkc9d"?>
<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/" xmlns:xmp="http://ns.adobe.com/xap/1.0/" xmlns:xmpMM="http://ns.adobe.com/xap/1.0/mm/" xmlns:pdf="http://ns.adobe.com/pdf/1.3/" xmlns:pdfxid="http://www.npes.org/pdfx/ns/id/">
<dc:format>application/pdf</dc:format>
<dc:title><rdf:Alt><rdf:li xml:lang="x-default">{}</rdf:li></rdf:Alt></dc:title>
<xmp:CreateDate>{}</xmp:CreateDate><xmp:ModifyDate>{}</xmp:ModifyDate><xmp:MetadataDate>{}</xmp:MetadataDate>
<xmp:CreatorTool>Belvedere</xmp:CreatorTool>
<xmpMM:DocumentID>urn:belvedere:{}</xmpMM:DocumentID><xmpMM:VersionID>1</xmpMM:VersionID><xmpMM:RenditionClass>default</xmpMM:RenditionClass>
<pdf:Producer>Belvedere {}, qpdf {}</pdf:Producer><pdf:Trapped>False</pdf:Trapped>{}
</rdf:Description></rdf:RDF></x:xmpmeta>
<?xpacket end="w"?>
)",
      "\xef\xbb\xbf", markup_text(title), date, date, date, id, program_version(),
      QPDF::QPDFVersion(),
      press ? "\n<pdfxid:GTS_PDFXVersion>PDF/X-4</pdfxid:GTS_PDFXVersion>" : "");
}

void describe(QPDF& pdf, const PdfParameters& parameters, const std::string& file) {
  const std::time_t when = time_of(file);
  const std::string title = parameters.title.empty() ? "Panorama" : parameters.title;
  const std::string date = fmt::format("D:{:%Y%m%d%H%M%S}+00'00'", fmt::gmtime(when));
  Handle info = Handle::newDictionary();
  info.replaceKey("/Title", Handle::newUnicodeString(title));
  info.replaceKey("/Creator", Handle::newString("Belvedere"));
  info.replaceKey("/Producer",
                  Handle::newString(fmt::format("Belvedere {}, qpdf {}", program_version(),
                                                QPDF::QPDFVersion())));
  info.replaceKey("/CreationDate", Handle::newString(date));
  info.replaceKey("/ModDate", Handle::newString(date));
  info.replaceKey("/Trapped", Handle::newName("/False"));
  pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(info));
  Handle xmp = pdf.newStream(metadata(title, when, !parameters.press.empty()));
  xmp.getDict().replaceKey("/Type", Handle::newName("/Metadata"));
  xmp.getDict().replaceKey("/Subtype", Handle::newName("/XML"));
  pdf.getRoot().replaceKey("/Metadata", pdf.makeIndirectObject(xmp));
}

void add_output_intent(QPDF& pdf, const std::vector<std::uint8_t>& press) {
  const std::string name = profile_name(press);
  Handle profile = pdf.newStream(std::string(press.begin(), press.end()));
  profile.getDict().replaceKey("/N", Handle::newInteger(4));
  Handle intent = Handle::newDictionary();
  intent.replaceKey("/Type", Handle::newName("/OutputIntent"));
  intent.replaceKey("/S", Handle::newName("/GTS_PDFX"));
  intent.replaceKey("/OutputConditionIdentifier", Handle::newString("Custom"));
  intent.replaceKey("/OutputCondition", Handle::newUnicodeString(name));
  intent.replaceKey("/Info",
                    Handle::newUnicodeString(name.empty() ? "profile without a name" : name));
  intent.replaceKey("/DestOutputProfile", pdf.makeIndirectObject(profile));
  Handle intents = Handle::newArray();
  intents.appendItem(pdf.makeIndirectObject(intent));
  pdf.getRoot().replaceKey("/OutputIntents", intents);
}

// A page's drawing: picture, labels over it, marks in all inks.
std::string page_content(const PrintPage& page, bool labels, bool marks) {
  std::string out =
      fmt::format("q {} {} {} {} re W n\n", points(page.shown.left), points(page.shown.bottom),
                  points(page.shown.width), points(page.shown.height));
  out += fmt::format("q {} 0 0 {} {} {} cm /Picture Do Q\n", points(page.picture.width),
                     points(page.picture.height), points(page.picture.left),
                     points(page.picture.bottom));
  if (labels)
    out += fmt::format("q 1 0 0 1 {} {} cm /Labels Do Q\n", points(page.picture.left),
                       points(page.picture.bottom));
  out += "Q\n";
  if (!marks) return out;
  out += "q .25 w /All CS 1 SCN\n";
  for (const MarkLine& line : crop_marks(page))
    out += fmt::format("{} {} m {} {} l S\n", points(line.from_mm.x), points(line.from_mm.y),
                       points(line.to_mm.x), points(line.to_mm.y));
  return out + "Q\n";
}

glm::dvec2 picture_size_mm(const PressPicture& picture, const PdfParameters& parameters) {
  if (parameters.width_mm <= 0.0 && picture.dots_per_inch <= 0.0)
    throw Error(ErrorKind::usage, picture.file, "does not state its resolution",
                "--width-mm, the width in print");
  const double mm_a_pixel = parameters.width_mm > 0.0 ? parameters.width_mm / picture.width
                                                      : 25.4 / picture.dots_per_inch;
  return {picture.width * mm_a_pixel, picture.height * mm_a_pixel};
}

Handle picture_object(QPDF& pdf, const PressPicture& picture, const PdfParameters& parameters,
                      std::shared_ptr<PictureData> data) {
  const bool press = !parameters.press.empty();
  const int channels = press ? 4 : 3;
  Handle object = pdf.newStream();
  Handle about = object.getDict();
  about.replaceKey("/Type", Handle::newName("/XObject"));
  about.replaceKey("/Subtype", Handle::newName("/Image"));
  about.replaceKey("/Width", Handle::newInteger(picture.width));
  about.replaceKey("/Height", Handle::newInteger(picture.height));
  about.replaceKey("/BitsPerComponent", Handle::newInteger(parameters.bits));
  about.replaceKey(
      "/ColorSpace",
      press ? Handle::newName("/DeviceCMYK")
            : icc_space(pdf, picture.profile.empty() ? srgb_profile() : picture.profile, 3));
  const Handle decode =
      Handle::parse(fmt::format("<< /Predictor 2 /Colors {} /BitsPerComponent {} /Columns {} >>",
                                channels, parameters.bits, picture.width));
  object.replaceStreamData(std::move(data), Handle::newName("/FlateDecode"), decode);
  return object;
}

}  // namespace

PdfReport write_print_pdf(const std::string& path, const PressPicture& picture,
                          const PdfParameters& parameters, Progress& progress) {
  const bool press = !parameters.press.empty();
  PdfReport report;
  report.picture_mm = picture_size_mm(picture, parameters);
  const std::vector<PrintPage> pages = plan_pages(report.picture_mm, parameters.pages);
  report.pages = pages.size();
  InkCount ink(!press                               ? 400.0
               : parameters.ink_limit_percent > 0.0 ? parameters.ink_limit_percent
                                                    : press_ink_limit_percent(parameters.press));
  const std::string drawing =
      parameters.labels.empty() ? std::string() : svg_as_pdf(parameters.labels, report.picture_mm);
  OutputFile file(path);
  try {
    QPDF pdf;
    pdf.emptyPDF();
    QPDF labels_pdf;  // outlives the writing: its streams are copied then
    Handle resources = Handle::parse("<< /XObject << >> >>");
    resources.getKey("/XObject")
        .replaceKey("/Picture", picture_object(pdf, picture, parameters,
                                               std::make_shared<PictureData>(picture, parameters,
                                                                             ink, progress)));
    if (!drawing.empty()) {
      labels_pdf.processMemoryFile("labels", drawing.data(), drawing.size());
      Handle form = pdf.copyForeignObject(
          QPDFPageDocumentHelper(labels_pdf).getAllPages().at(0).getFormXObjectForPage());
      std::set<QPDFObjGen> done;
      settle_colours(form, pdf.makeIndirectObject(icc_space(pdf, srgb_profile(), 3)), done);
      resources.getKey("/XObject").replaceKey("/Labels", form);
    }
    // Registration colour: every plate has the marks.
    resources.replaceKey("/ColorSpace",
                         Handle::parse("<< /All [/Separation /All /DeviceCMYK << /FunctionType 2 "
                                       "/Domain [0 1] /C0 [0 0 0 0] /C1 [1 1 1 1] /N 1 >>] >>"));
    const Handle shared = pdf.makeIndirectObject(resources);
    for (const PrintPage& plan : pages) {
      Handle page = Handle::parse("<< /Type /Page >>");
      page.replaceKey("/MediaBox", box_handle({0.0, 0.0, plan.size_mm.x, plan.size_mm.y}));
      page.replaceKey("/BleedBox", box_handle(plan.shown));
      page.replaceKey("/TrimBox", box_handle(plan.trim));
      page.replaceKey("/Resources", shared);
      page.replaceKey("/Contents",
                      pdf.newStream(page_content(plan, !drawing.empty(), parameters.pages.marks)));
      pdf.addPage(pdf.makeIndirectObject(page), false);
    }
    describe(pdf, parameters, picture.file);
    if (press) add_output_intent(pdf, parameters.press);
    QPDFWriter writer(pdf, file.temporary().c_str());
    writer.setMinimumPDFVersion("1.6");
    writer.setObjectStreamMode(qpdf_o_disable);
    writer.setDeterministicID(true);
    writer.write();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {  // exceptions of qpdf
    file.fail(e.what());
  }
  file.prepare();
  file.commit();
  report.ink = ink.coverage();
  return report;
}

}  // namespace belvedere
