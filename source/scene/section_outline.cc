#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/scene/section.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    std::string at_line(const unsigned int number, const std::string &file)
    {
      return "Line " + std::to_string(number) + " of the section outline " + file;
    }

    /// A corner of a drawn outline [m].
    struct Corner
    {
      Point<2> place;
      double rounding = 0;
      std::string part, region;
      unsigned int line = 0;
    };

    /// Edges and roundings of a polygon.
    void add_polygon(const std::vector<Corner> &corners, const std::string &file,
                     std::vector<SectionOutline::Row> &rows)
    {
      const unsigned int n = corners.size();
      if (n < 3)
        throw InputError(at_line(corners.front().line, file) + " begins a region of " + std::to_string(n) +
                         " corners: an outline has three or more.");
      // where the arc of each corner begins and ends
      std::vector<SectionOutline::Row> arcs(n);
      std::vector<double> cut(n, 0.);
      for (unsigned int k = 0; k < n; ++k)
      {
        const Corner &here = corners[k];
        SectionOutline::Row &arc = arcs[k];
        arc.start = arc.end = here.place;
        Tensor<1, 2> back = corners[(k + n - 1) % n].place - here.place,
                     on = corners[(k + 1) % n].place - here.place;
        if (!(on.norm() > 0))
          throw InputError(at_line(here.line, file) +
                           " has its corner where the next one is: leave one of them out.");
        back /= back.norm();
        on /= on.norm();
        const double cosine = std::clamp(back * on, -1., 1.);
        if (here.rounding == 0 || cosine < -1 + 1e-12)
          continue;
        const double half = std::acos(cosine) / 2;
        cut[k] = here.rounding / std::tan(half);
        Tensor<1, 2> inward = back + on;
        inward /= inward.norm();
        arc.is_arc = true;
        arc.radius = here.rounding;
        arc.start = here.place + cut[k] * back;
        arc.end = here.place + cut[k] * on;
        arc.centre = here.place + here.rounding / std::sin(half) * inward;
        arc.part = here.part;
        arc.line = here.line;
        arc.region = here.region;
      }
      for (unsigned int k = 0; k < n; ++k)
      {
        const unsigned int next = (k + 1) % n;
        const double length = corners[k].place.distance(corners[next].place),
                     left = length - cut[k] - cut[next];
        if (left < -1e-9 * length)
          throw InputError(at_line(corners[k].line, file) +
                           ": the roundings at both ends of the edge that begins here take " +
                           number_text(1e3 * (cut[k] + cut[next])) + " mm of its " +
                           number_text(1e3 * length) + " mm; give smaller ones.");
        if (arcs[k].is_arc)
        {
          // a rounding belongs to no part with a name of its own
          arcs[k].part = "surface";
          rows.push_back(arcs[k]);
        }
        if (left > 1e-9 * length)
        {
          SectionOutline::Row line;
          line.start = arcs[k].end;
          line.end = arcs[next].start;
          line.part = corners[k].part;
          line.line = corners[k].line;
          line.region = corners[k].region;
          rows.push_back(line);
        }
      }
    }

    std::vector<SectionOutline::Row> read_corners(std::istream &stream, const std::string &file,
                                                  const double mm)
    {
      std::vector<SectionOutline::Row> rows;
      std::vector<Corner> polygon;
      std::string line;
      bool header = true;
      for (unsigned int number = 1; std::getline(stream, line); ++number)
      {
        if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#')
          continue;
        std::vector<std::string> fields = dealii::Utilities::split_string_list(line, ',');
        char *rest = nullptr;
        if (header && !fields.empty() && (std::strtod(fields[0].c_str(), &rest), rest == fields[0].c_str()))
        {
          header = false;
          continue;
        }
        header = false;
        Corner corner;
        corner.line = number;
        double v[3] = {};
        bool good = fields.size() == 4 || fields.size() == 5;
        for (unsigned int d = 0; d < 3 && good; ++d)
        {
          v[d] = std::strtod(fields[d].c_str(), &rest);
          good = !fields[d].empty() && *rest == 0 && std::isfinite(v[d]);
        }
        if (!good || v[2] < 0 || fields[3].empty())
          throw InputError(
              at_line(number, file) +
              " is no corner; it must read: a, b, rounding radius (mm), part[, region], for example "
              "-95, 92.5, 0, surface.");
        corner.place = Point<2>(mm * v[0], mm * v[1]);
        corner.rounding = mm * v[2];
        corner.part = fields[3];
        corner.region = fields.size() == 5 ? fields[4] : "";
        if (!polygon.empty() && polygon.back().region != corner.region)
        {
          add_polygon(polygon, file, rows);
          polygon.clear();
        }
        polygon.push_back(corner);
      }
      if (!polygon.empty())
        add_polygon(polygon, file, rows);
      return rows;
    }

    /// One curve per row.
    std::vector<SectionOutline::Row> read_curves(std::istream &stream, const std::string &file,
                                                 const double mm)
    {
      std::vector<SectionOutline::Row> rows;
      std::string line;
      for (unsigned int number = 1; std::getline(stream, line); ++number)
      {
        if (line.empty() || line[0] == '#')
          continue;
        std::istringstream fields(line);
        std::string kind, part, region;
        double v[7];
        fields >> kind;
        for (double &x : v)
          fields >> x;
        fields >> part;
        if (!fields || (kind != "line" && kind != "arc"))
          throw InputError(at_line(number, file) +
                           " is no curve; it must read: line|arc a1 b1 a2 b2 ac bc R part [region] (mm).");
        fields >> region;
        SectionOutline::Row row;
        row.is_arc = kind == "arc";
        row.start = Point<2>(mm * v[0], mm * v[1]);
        row.end = Point<2>(mm * v[2], mm * v[3]);
        row.centre = Point<2>(mm * v[4], mm * v[5]);
        row.radius = mm * v[6];
        row.part = part;
        row.line = number;
        row.region = region;
        rows.push_back(row);
      }
      return rows;
    }

    std::vector<SectionOutline::Row> rows_of(const std::string &text, const std::string &file,
                                             const double scale)
    {
      std::istringstream stream(text);
      const double mm = 1e-3 * scale;
      const std::string ending = ".csv";
      const bool has_corners = file.size() > ending.size() &&
                               file.compare(file.size() - ending.size(), ending.size(), ending) == 0;
      const std::vector<SectionOutline::Row> rows =
          has_corners ? read_corners(stream, file, mm) : read_curves(stream, file, mm);
      if (rows.empty())
        throw InputError("The section outline " + file + " holds no " +
                         (has_corners
                              ? "corner; it needs rows such as: -95, 92.5, 0, surface."
                              : "curve; it needs rows such as: line|arc a1 b1 a2 b2 ac bc R part (mm)."));
      return rows;
    }
  } // namespace

  SectionOutline SectionOutline::read(const std::string &file, const double scale)
  {
    std::ifstream bytes(file, std::ios::binary);
    if (!bytes)
      throw InputError("Cannot read the section outline " + file + "; give the path of an existing file.");
    const std::string content{std::istreambuf_iterator<char>(bytes), std::istreambuf_iterator<char>()};
    SectionOutline outline;
    outline.tolerance *= scale;
    // Of outlines that were read: the cases of a sweep ask for the same ones. A file that has changed is read again.
    static std::map<std::pair<std::string, double>, std::pair<std::string, std::vector<Row>>> known;
    auto &[known_content, known_rows] = known[{file, scale}];
    if (known_rows.empty() || known_content != content)
    {
      // names of parts and regions are those of the parameter file, which is UTF-8
      known_rows = rows_of(as_utf8(content), file, scale);
      known_content = content;
    }
    outline.rows = known_rows;
    return outline;
  }

  bool SectionOutline::contains(const Row &row, const Point<2> &p) const
  {
    const Tensor<1, 2> chord = row.end - row.start;
    const double along = (p - row.start) * chord / chord.norm_square();
    if (along < -tolerance / chord.norm() || along > 1 + tolerance / chord.norm())
      return false;
    const Tensor<1, 2> normal({-chord[1] / chord.norm(), chord[0] / chord.norm()});
    if (!row.is_arc)
      return std::abs((p - row.start) * normal) < tolerance;
    // The shorter arc lies on the side of the chord away from the centre.
    const double side = (p - row.start) * normal, centre_side = (row.centre - row.start) * normal;
    return std::abs(p.distance(row.centre) - row.radius) < tolerance &&
           (side * centre_side <= 0 || std::abs(side) < tolerance);
  }

  unsigned int SectionOutline::find(const std::vector<Point<2>> &points) const
  {
    for (unsigned int k = 0; k < rows.size(); ++k)
    {
      bool all = true;
      for (const Point<2> &p : points)
        all = all && contains(rows[k], p);
      if (all)
        return k;
    }
    return rows.size();
  }
} // namespace vibrocontact
