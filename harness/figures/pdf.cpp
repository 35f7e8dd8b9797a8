// SPDX-License-Identifier: MIT
#include <cairo-pdf.h>

#include <memory>
#include <numbers>

#include "drawing.hpp"
#include "errors.hpp"

namespace shakedown {

namespace {

cairo_status_t add_bytes(void* to, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void trace(cairo_t* page, const Mark& mark) {
  for (const DrawnPoint& point : mark.points) cairo_line_to(page, point.x, point.y);
}

void draw_text(cairo_t* page, const Mark& mark) {
  cairo_text_extents_t size;
  cairo_text_extents(page, mark.text.c_str(), &size);
  const double before = mark.anchor == Anchor::start    ? 0
                        : mark.anchor == Anchor::middle ? size.x_advance / 2
                                                        : size.x_advance;
  cairo_save(page);
  cairo_translate(page, mark.points.front().x, mark.points.front().y);
  if (mark.turned) cairo_rotate(page, -std::numbers::pi / 2);
  cairo_move_to(page, -before, 0);
  cairo_show_text(page, mark.text.c_str());
  cairo_restore(page);
}

void draw(cairo_t* page, const Mark& mark) {
  cairo_set_source_rgba(page, mark.colour[0], mark.colour[1], mark.colour[2], mark.opacity);
  cairo_new_path(page);
  switch (mark.kind) {
    case Mark::Kind::line:
      trace(page, mark);
      cairo_set_line_width(page, mark.width);
      cairo_set_dash(page, mark.dash.data(), static_cast<int>(mark.dash.size()), 0);
      cairo_stroke(page);
      break;
    case Mark::Kind::area:
      trace(page, mark);
      cairo_close_path(page);
      cairo_fill(page);
      break;
    case Mark::Kind::dots:
      for (const DrawnPoint& point : mark.points) {
        cairo_new_sub_path(page);
        cairo_arc(page, point.x, point.y, mark.width / 2, 0, 2 * std::numbers::pi);
      }
      cairo_fill(page);
      break;
    case Mark::Kind::text: draw_text(page, mark); break;
  }
}

}  // namespace

std::string pdf_of(const Drawing& drawing) {
  std::string bytes;
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_pdf_surface_create_for_stream(add_bytes, &bytes, drawing.width, drawing.height),
      cairo_surface_destroy);
  // Without packed objects; journals take it.
  cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);
  // Else the moment of writing stands in it.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  {
    const std::unique_ptr<cairo_t, void (*)(cairo_t*)> page(cairo_create(surface.get()), cairo_destroy);
    cairo_select_font_face(page.get(), "Helvetica", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(page.get(), letter_size);
    cairo_set_line_join(page.get(), CAIRO_LINE_JOIN_ROUND);
    for (const Mark& mark : drawing.marks) draw(page.get(), mark);
    cairo_show_page(page.get());
    status = cairo_status(page.get());
  }
  cairo_surface_finish(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    throw FileError(std::string("the PDF cannot be made: cairo says \"") + cairo_status_to_string(status) +
                    "\"");
  return bytes;
}

}  // namespace shakedown
