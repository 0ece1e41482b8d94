#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/locally_owned_values.h>
#include <vibrocontact/reduction/wheel_labels.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int max_diameters = 24;
    constexpr unsigned int n_raster = 5; // raster of the rim's section, each way
    static_assert(n_raster * n_raster == WheelRaster::n_rim);
    constexpr double faint = 0.03; // of the largest axial motion: no sign is read from less

    using Complex = std::complex<double>;

    // Mean over a ring of the section of u exp(-i n theta), for all n.
    struct Ring
    {
      double mass = 0;
      std::array<Complex, max_diameters + 1> sum{};
    };

    // Nodes seen from the axle.
    struct Polar
    {
      double radius, y, sine, cosine, mass;
    };

    unsigned int cell(const double value, const double low, const double high, const unsigned int n)
    {
      return std::min<unsigned int>(n - 1, std::max(0., (value - low) / (high - low) * n));
    }
  } // namespace

  void WheelRaster::check(const std::string &body) const
  {
    if (!(r_min < rim_radius && rim_radius < r_max))
      throw InputError("Body '" + body + "', section Modes: Rim radius = " + number_text(rim_radius) +
                       " m is not inside the wheel (radii " + number_text(r_min) + " to " +
                       number_text(r_max) + " m); set it to the radius where the rim begins.");
  }

  unsigned int WheelRaster::rim_cell(const double radius, const double y) const
  {
    return cell(radius, rim_radius, r_max, n_raster) * n_raster + cell(y, y_min, y_max, n_raster);
  }

  unsigned int WheelRaster::ring(const double radius) const
  {
    return cell(radius, r_min, r_max, n_rings);
  }

  WheelLabel wheel_label(const WheelMotion &motion)
  {
    const unsigned int n = motion.nodal_diameters;
    const auto &energy = motion.rim_energy;
    WheelLabel label;
    label.nodal_diameters = n;
    const unsigned int family = std::max_element(energy.begin(), energy.end()) - energy.begin();
    label.family = family == 0 ? "axial" : family == 1 ? "radial" : n == 0 ? "torsion" : "circumferential";

    // The axial motion along the radius, turned to the phase that holds most of it.
    Complex square = 0;
    for (const Complex &value : motion.axial)
      square += value * value;
    const Complex phase = std::exp(Complex(0, -std::arg(square) / 2));
    // Pure torsion has no axial motion but round-off: no signs are read from less than a thousandth of the
    // rim's motion.
    double largest = 1e-3 / faint * std::sqrt((energy[0] + energy[1] + energy[2]) / motion.rim_mass),
           last = 0;
    for (const Complex &value : motion.axial)
      largest = std::max(largest, std::abs((value * phase).real()));
    for (const Complex &value : motion.axial)
      if (const double here = (value * phase).real(); std::abs(here) > faint * largest)
      {
        if (here * last < 0)
          ++label.nodal_circles;
        last = here;
      }
    return label;
  }

  std::vector<WheelLabel> wheel_labels(const SecondOrderSystem &system, const Modes &modes,
                                       const WheelFrame &frame)
  {
    const unsigned int n_local = system.locally_owned.n_elements();
    AssertThrow(system.dof_position.size() == n_local, dealii::ExcInternalError());
    dealii::PETScWrappers::MPI::Vector diagonal(system.locally_owned, system.communicator);
    MatGetDiagonal(system.mass, diagonal);
    const std::vector<double> masses = locally_owned_values(diagonal);

    const double huge = std::numeric_limits<double>::max();
    double r_min = huge, r_max = 0, y_min = huge, y_max = -huge;
    std::vector<Polar> nodes(n_local);
    for (unsigned int i = 0; i < n_local; ++i)
    {
      const auto &p = system.dof_position[i];
      const double z = p[2] - frame.axle_height, r = std::hypot(p[0], z);
      // The angle is counted from the contact point (x = 0, below the axle); a node on the axle has none.
      nodes[i] = r > 0 ? Polar{r, p[1], p[0] / r, -z / r, masses[i]} : Polar{0, p[1], 0, 1, masses[i]};
      r_min = std::min(r_min, r);
      r_max = std::max(r_max, r);
      if (r > frame.rim_radius)
      {
        y_min = std::min(y_min, p[1]);
        y_max = std::max(y_max, p[1]);
      }
    }
    const MPI_Comm communicator = system.communicator;
    r_min = dealii::Utilities::MPI::min(r_min, communicator);
    r_max = dealii::Utilities::MPI::max(r_max, communicator);
    y_min = dealii::Utilities::MPI::min(y_min, communicator);
    y_max = dealii::Utilities::MPI::max(y_max, communicator);
    const WheelRaster raster{r_min, r_max, y_min, y_max, frame.rim_radius};
    raster.check(system.body);
    constexpr unsigned int n_rim = WheelRaster::n_rim, n_web = WheelRaster::n_rings;
    // rings: 3 components of the rim's raster, then the axial motion by radius
    constexpr unsigned int n_rings = 3 * n_rim + n_web;
    constexpr unsigned int stride = 1 + 2 * (max_diameters + 1);

    std::vector<WheelLabel> labels;
    for (const auto &shape : modes.shapes)
    {
      std::vector<Ring> rings(n_rings);
      const std::vector<double> u = locally_owned_values(shape);
      const auto add = [&](Ring &ring, const Polar &node, const double value)
      {
        const Complex turn(node.cosine, -node.sine);
        Complex factor = node.mass * value;
        for (Complex &sum : ring.sum)
        {
          sum += factor;
          factor *= turn;
        }
      };
      for (unsigned int i = 0; i < n_local; ++i)
      {
        const Polar &node = nodes[i];
        const unsigned char direction = system.dof_direction[i];
        if (node.radius > frame.rim_radius)
        {
          const unsigned int k = raster.rim_cell(node.radius, node.y);
          // e_r = (sin, -cos), e_theta = (cos, sin) in x and z
          if (direction == 1)
          {
            add(rings[k], node, u[i]);
            rings[k].mass += node.mass;
          }
          else
          {
            add(rings[n_rim + k], node, direction == 0 ? node.sine * u[i] : -node.cosine * u[i]);
            add(rings[2 * n_rim + k], node, direction == 0 ? node.cosine * u[i] : node.sine * u[i]);
          }
        }
        if (direction == 1)
        {
          Ring &ring = rings[3 * n_rim + raster.ring(node.radius)];
          add(ring, node, u[i]);
          ring.mass += node.mass;
        }
      }
      static_assert(sizeof(Ring) == stride * sizeof(double));
      MPI_Allreduce(MPI_IN_PLACE, rings.data(), n_rings * stride, MPI_DOUBLE, MPI_SUM, communicator);

      std::array<std::array<double, max_diameters + 1>, 3> energy{};
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int k = 0; k < n_rim; ++k)
          if (rings[k].mass > 0)
            for (unsigned int n = 0; n <= max_diameters; ++n)
              energy[c][n] += (n == 0 ? 1 : 2) * std::norm(rings[c * n_rim + k].sum[n]) / rings[k].mass;

      WheelMotion motion;
      double most = -1;
      for (unsigned int n = 0; n <= max_diameters; ++n)
      {
        const double here = energy[0][n] + energy[1][n] + energy[2][n];
        if (here > most)
        {
          most = here;
          motion.nodal_diameters = n;
        }
      }
      const unsigned int n = motion.nodal_diameters;
      for (unsigned int c = 0; c < 3; ++c)
        motion.rim_energy[c] = energy[c][n];
      for (unsigned int k = 0; k < n_rim; ++k)
        motion.rim_mass += rings[k].mass;
      for (unsigned int k = 0; k < n_web; ++k)
        if (const Ring &ring = rings[3 * n_rim + k]; ring.mass > 0)
          motion.axial.push_back(ring.sum[n] / ring.mass);
      labels.push_back(wheel_label(motion));
    }
    return labels;
  }

  std::vector<std::string> unique_texts(const std::vector<WheelLabel> &labels)
  {
    std::vector<std::string> texts;
    std::map<std::string, unsigned int> seen;
    for (const auto &label : labels)
    {
      const std::string text = label.text();
      const unsigned int number = ++seen[text];
      texts.push_back(number == 1 ? text : text + "#" + std::to_string(number));
    }
    return texts;
  }

  std::vector<double> wheel_damping(const std::vector<WheelLabel> &labels, const ModeParameters &parameters)
  {
    std::vector<double> zeta;
    for (const auto &label : labels)
      zeta.push_back(label.nodal_diameters == 0   ? parameters.damping_0
                     : label.nodal_diameters == 1 ? parameters.damping_1
                                                  : parameters.damping_2);
    return zeta;
  }
} // namespace vibrocontact
