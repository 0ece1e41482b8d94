#include <vibrocontact/analyses/stability/unstable_shapes.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/contact/body_places.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/surface_fields.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int n_frames = 12;
    /// shapes are written of so many roots, those that grow fastest
    constexpr unsigned int most_shapes = 8;
    constexpr double largest_amplitude = 1e-3;

    /// real and imaginary part of a complex field on a body's surface
    struct SurfaceShape
    {
      const MeshedBody *body;
      const SurfaceShapes *surface;
      std::vector<double> real, imaginary;
      /// of the body in the scene [m]
      std::array<double, 3> place;
    };

    void write_frames(const SurfaceShape &shape, const double scale, const unsigned int number,
                      const std::string &folder)
    {
      const std::string set = "unstable_" + std::to_string(number) + "_" + shape.body->parameters.name;
      std::vector<std::pair<double, std::string>> files;
      for (unsigned int frame = 0; frame < n_frames; ++frame)
      {
        const double phase = 2 * dealii::numbers::PI * frame / n_frames;
        std::vector<double> displacement(shape.real.size());
        for (unsigned int i = 0; i < displacement.size(); ++i)
          displacement[i] = scale * (shape.real[i] * std::cos(phase) - shape.imaginary[i] * std::sin(phase));
        files.emplace_back(double(frame) / n_frames, field_name(set, frame));
        write_surface(shape.surface->points, shape.surface->quads, {{"displacement_m", displacement}},
                      folder + "/" + files.back().second, shape.place);
      }
      write_pvd(files, folder + "/" + set + ".pvd");
    }
  } // namespace

  void write_unstable_shapes(const StabilityResult &result, const ContactPair &pair,
                             const MeshedBodies &bodies, const std::string &folder)
  {
    std::vector<const StabilityRoot *> fastest = result.unstable();
    if (fastest.size() > most_shapes)
    {
      run_log().line("shapes are written of the " + std::to_string(most_shapes) + " of " +
                     std::to_string(fastest.size()) + " unstable roots that grow fastest");
      std::partial_sort(fastest.begin(), fastest.begin() + most_shapes, fastest.end(),
                        [](const auto *a, const auto *b) { return a->growth > b->growth; });
      fastest.resize(most_shapes);
    }
    const std::vector<std::array<double, 3>> places =
        places_of_bodies(pair.interface.contacts, bodies.size());
    const SuspendedHub *const hub = result.suspended ? result.suspended->hub.get() : nullptr;
    std::vector<std::unique_ptr<SurfaceShapes>> surfaces(bodies.size());
    unsigned int number = 0;
    for (const StabilityRoot *const root : result.unstable())
    {
      if (std::find(fastest.begin(), fastest.end(), root) == fastest.end())
      {
        ++number;
        continue;
      }
      std::vector<SurfaceShape> shapes;
      double largest = 0;
      for (unsigned int k = 0; k < bodies.size(); ++k)
      {
        // known by poles at its contact points
        if (!bodies[k] || bodies[k]->parameters.has_complex_modes())
          continue;
        if (!bodies[k]->reduction.has_surface_shapes())
        {
          if (number == 0)
            run_log().line("no shapes of unstable roots on " + bodies[k]->parameters.name +
                           ": the cache has its modes without their shapes");
          continue;
        }
        std::vector<std::complex<double>> amplitudes = root->shape;
        std::array<std::complex<double>, 6> moved{};
        if (hub)
        {
          amplitudes = hub->held(root->shape);
          const auto first = amplitudes.begin() + hub->n_held_modes();
          std::copy_n(first, hub->n_motions, moved.begin());
          amplitudes.erase(first, first + hub->n_added);
        }
        std::vector<double> real, imaginary;
        for (unsigned int i = 0; i < pair.n_modes(); ++i)
          if (pair.body[i] == k + 1)
          {
            real.push_back(amplitudes[i].real());
            imaginary.push_back(amplitudes[i].imag());
          }
        if (!surfaces[k])
          surfaces[k] = std::make_unique<SurfaceShapes>(shapes_of_modes(*bodies[k], bodies[k]->parameters));
        const SurfaceShapes &surface = *surfaces[k];
        shapes.push_back({bodies[k].get(), &surface, surface_displacement(surface, real),
                          surface_displacement(surface, imaginary), places[k]});
        for (unsigned int point = 0; hub && k == 0 && point < surface.n_points(); ++point)
        {
          const auto carried =
              hub->carried(surface.point(point), [&](const unsigned int m) { return moved[m]; });
          for (unsigned int d = 0; d < 3; ++d)
          {
            shapes.back().real[3 * point + d] += carried[d].real();
            shapes.back().imaginary[3 * point + d] += carried[d].imag();
          }
        }
        for (unsigned int i = 0; i < shapes.back().real.size(); ++i)
          largest = std::max(largest, std::hypot(shapes.back().real[i], shapes.back().imaginary[i]));
      }
      for (const SurfaceShape &shape : shapes)
        on_first_rank(
            [&] { write_frames(shape, largest_amplitude / std::max(largest, 1e-300), number, folder); });
      ++number;
    }
  }
} // namespace vibrocontact
