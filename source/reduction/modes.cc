#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/block_product.h>
#include <vibrocontact/reduction/locally_owned_values.h>
#include <vibrocontact/reduction/modes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  void ModeParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Upper frequency", upper_frequency,
                      "All modes up to this frequency are computed; 0: as many as Count says. Units: Hz.",
                      Double(0, 1e6));
    prm.add_parameter(
        "Count", count,
        "Number of elastic modes, one more if it would split a pair; 0: go by Upper frequency. Units: none.",
        Integer(0, 20000));
    prm.add_parameter("Damping ratio 0 nodal diameters", damping_0,
                      "Modal damping ratio of a wheel's modes without nodal diameter (Eq. 23). Units: none.",
                      Double(0, 1));
    prm.add_parameter("Damping ratio 1 nodal diameter", damping_1,
                      "Modal damping ratio of a wheel's modes with one nodal diameter (Eq. 23). Units: none.",
                      Double(0, 1));
    prm.add_parameter(
        "Damping ratio 2 nodal diameters", damping_2,
        "Modal damping ratio of a wheel's modes with two or more nodal diameters (Eq. 23). Units: none.",
        Double(0, 1));
    prm.add_parameter(
        "Damping factor", damping_factor,
        "All modal damping ratios of the body times this factor; the reduction in the cache stays "
        "valid. Units: none.",
        Double(0, 1e6));
    prm.add_parameter(
        "Stiffness damping", stiffness_damping,
        "beta of a viscous damping proportional to the stiffness, C = beta K: adds beta w / 2 to every "
        "modal damping ratio. Units: s.",
        Double(0, 1e6));
    prm.add_parameter(
        "Rim radius", rim_radius,
        "Points of a wheel further than this from its axle are its rim, whose motion names the family of a "
        "mode; 0: 0.385 m, that of the shipped wheel, times Wheel/Scale. Units: m.",
        Double(0, 100));
  }

  std::vector<double> ModeParameters::scaled(std::vector<double> damping_ratio,
                                             const std::vector<double> &omega) const
  {
    for (unsigned int k = 0; k < omega.size(); ++k)
      damping_ratio[k] = damping_factor * damping_ratio[k] + stiffness_damping * omega[k] / 2;
    return damping_ratio;
  }

  void ModeParameters::check(const std::string &section) const
  {
    if (upper_frequency > 0 && count > 0)
      throw InputError("Section '" + section + "': Upper frequency = " + number_text(upper_frequency) +
                       " Hz and Count = " + std::to_string(count) +
                       " contradict each other; set one of them to 0.");
  }

  std::string ModeParameters::key() const
  {
    std::ostringstream text;
    text.precision(17);
    text << upper_frequency << ' ' << count << ' ' << damping_0 << ' ' << damping_1 << ' ' << damping_2 << ' '
         << rim_radius;
    return text.str();
  }

  void sort(Modes &modes)
  {
    std::vector<unsigned int> order(modes.omega.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](const unsigned int a, const unsigned int b)
                     { return modes.omega[a] < modes.omega[b]; });
    std::vector<double> omega;
    std::vector<dealii::PETScWrappers::MPI::Vector> shapes;
    for (const unsigned int i : order)
    {
      omega.push_back(modes.omega[i]);
      shapes.push_back(modes.shapes[i]);
    }
    modes.omega = std::move(omega);
    modes.shapes = std::move(shapes);
  }

  void take_frequencies_of_shapes(const SecondOrderSystem &system, const unsigned int first, Modes &modes)
  {
    constexpr unsigned int block_size = 16;
    modes.omega.resize(first);
    for (unsigned int begin = first; begin < modes.shapes.size(); begin += block_size)
    {
      const unsigned int n = std::min<unsigned int>(block_size, modes.shapes.size() - begin);
      const std::vector<double> shapes = locally_owned_values(modes.shapes, begin, n),
                                elastic = block_product(system.stiffness, shapes, n),
                                inertial = block_product(system.mass, shapes, n);
      // of each shape, phi^T K phi and phi^T M phi
      std::vector<double> products(2 * n);
      const std::size_t n_rows = shapes.size() / n;
      for (unsigned int k = 0; k < n; ++k)
      {
        const auto shape = shapes.begin() + k * n_rows;
        products[2 * k] = std::inner_product(shape, shape + n_rows, elastic.begin() + k * n_rows, 0.);
        products[2 * k + 1] = std::inner_product(shape, shape + n_rows, inertial.begin() + k * n_rows, 0.);
      }
      dealii::Utilities::MPI::sum(products, system.communicator, products);
      for (unsigned int k = 0; k < n; ++k)
      {
        const double square = products[2 * k] / products[2 * k + 1];
        if (!(square > 0))
          throw ConvergenceError("Body '" + system.body + "': a mode has the squared frequency " +
                                 number_text(square) +
                                 " (rad/s)^2, which is not positive; is the body held, and does its mesh "
                                 "have cells of reasonable shape?");
        modes.omega.push_back(std::sqrt(square));
      }
    }
    sort(modes);
  }
} // namespace vibrocontact
