#include <vibrocontact/analyses/frequency_response/wheel_attachments.h>

#include <cmath>

namespace vibrocontact
{
  void attach(const std::vector<Attachment> &attachments, const double share, const double omega,
              Receptance &H)
  {
    using Complex = std::complex<double>;
    const unsigned int n = std::lround(std::sqrt(double(H.size()))), n_a = attachments.size();
    if (n_a == 0)
      return;
    // p f = -q u with -q / p = -Z, divided by the mass as far as that goes: all of it is finite at resonance
    std::vector<Complex> A(std::size_t(n_a) * n_a), forces(std::size_t(n_a) * n);
    for (unsigned int a = 0; a < n_a; ++a)
    {
      const Attachment &one = attachments[a];
      const Complex square = Complex(one.omega * one.omega) * Complex(1, one.loss_factor);
      const Complex p = one.is_sprung() ? square - omega * omega : Complex(1),
                    q = -share * one.mass * omega * omega * (one.is_sprung() ? square : Complex(1));
      for (unsigned int b = 0; b < n_a; ++b)
        A[std::size_t(b) * n_a + a] = q * H[one.row * n + attachments[b].row] + (a == b ? p : Complex(0));
      for (unsigned int j = 0; j < n; ++j)
        forces[std::size_t(j) * n_a + a] = -q * H[one.row * n + j];
    }
    solve_by_columns(A, forces);
    const Receptance bare = H;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int a = 0; a < n_a; ++a)
          H[i * n + j] += bare[i * n + attachments[a].row] * forces[std::size_t(j) * n_a + a];
  }

  WheelAttachments wheel_attachments(const RevolvedSection &section, const std::vector<WheelDamper> &dampers,
                                     const std::string &path)
  {
    WheelAttachments result;
    const RevolvedShapes outline = shapes_without_modes(section);
    bool any_layer = false;
    for (const WheelDamper &damper : dampers)
    {
      any_layer = any_layer || damper.is_layer();
      if (damper.is_layer())
        continue;
      const unsigned int point = point_of(outline, damper, path);
      const std::array<TraceRow, 3> rows =
          section.node({outline.points[2 * point], outline.points[2 * point + 1]}, path + "/" + damper.name);
      for (unsigned int k = 0; k < (damper.is_ring() ? 1 : damper.number); ++k)
        for (unsigned int c = 0; c < 3; ++c)
        {
          Attachment mass{sprung_mass(damper, c)};
          if (damper.is_ring())
          {
            mass.row = result.ring_rows.size();
            result.ring_rows.push_back(rows[c]);
            result.rings.push_back(mass);
            continue;
          }
          RevolvedPoint place;
          place.rows = rows;
          place.angle = angle_of(damper, k);
          place.component = c;
          place.in_section_axes = true;
          mass.row = result.places.size();
          result.places.push_back(place);
          result.absorbers.push_back(mass);
        }
    }
    if (any_layer)
      result.layers = loss_of_layers(outline, dampers, path);
    return result;
  }
} // namespace vibrocontact
