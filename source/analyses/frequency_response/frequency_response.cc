#include <vibrocontact/analyses/frequency_response/frequency_response.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  void FrequencyResponseParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Points", points,
        "Places where the body is excited and observed, separated by semicolons: \"name: x, y, direction\" "
        "on the surface that can come into contact, or \"name: x, y, z, direction\" at the node next to a "
        "place; direction x, y or z; coordinates of the contact. Units: m.",
        Anything());
    prm.add_parameter(
        "Bodies", bodies,
        "Bodies to be analysed, separated by commas: bodies with modes, analytic rings, oscillators, "
        "identified bodies; empty: all of them. Units: none.",
        Anything());
    prm.add_parameter("First frequency", first, "Lowest frequency; 0 if the spacing is linear. Units: Hz.",
                      Double(0, 1e9));
    prm.add_parameter("Last frequency", last, "Highest frequency. Units: Hz.", Double(1e-6, 1e9));
    prm.add_parameter("Number of frequencies", count, "Frequencies from first to last. Units: none.",
                      Integer(2, 100000));
    prm.add_parameter("Spacing", spacing, "How the frequencies are spaced. Units: none.",
                      Selection("logarithmic|linear"));
    prm.add_parameter(
        "Frequencies", list,
        "Frequencies one by one, ascending, in place of first, last, number and spacing. Units: Hz.",
        List(Double(1e-6, 1e9), 0, 10000, ","));
    prm.add_parameter(
        "Refined frequencies", n_refined,
        "Further frequencies, placed in turn where the magnitude at the driving points bends most over those "
        "so far: "
        "they gather at resonances and antiresonances. Bodies with modes or directly solved. Units: none.",
        Integer(0, 100000));
    prm.add_parameter("Check frequencies", check_frequencies,
                      "Frequencies at which the unreduced complex system is solved as well and all methods "
                      "are compared. Units: Hz.",
                      List(Double(1e-6, 1e9), 0, 1000, ","));
    prm.add_parameter("Cut frequencies", cut_frequencies,
                      "The comparison is repeated with the modes below each of these only. Units: Hz.",
                      List(Double(0, 1e9), 0, 100, ","));
    prm.add_parameter("Quantity", quantity,
                      "mobility: velocity per force; receptance: displacement per force. Units: none.",
                      Selection("mobility|receptance"));
    prm.add_parameter(
        "Method", method,
        "modal: complex modal stiffness with residual; direct: the unreduced complex system at every "
        "frequency. Beside either, if the body has modes, the modal damping of a run in time. Units: none.",
        Selection("modal|direct"));
    prm.add_parameter("Load length", load_length,
                      "Length along x of the patch of surface that carries a force; its motion is the mean "
                      "over the patch. Units: m.",
                      Double(1e-5, 100));
    prm.add_parameter("Load width", load_width, "Width along y of that patch. Units: m.", Double(1e-5, 100));
    prm.add_parameter(
        "Truncated orders", truncated_orders,
        "Analytic rings: what is lost if the circumferential orders above each of these are left out or "
        "answer statically (error E of the tyre paper, Eq. 9). Units: none.",
        List(Integer(0, 5000), 0, 100, ","));
    prm.add_parameter("Tangential", tangential,
                      "Analytic rings: forces and displacements along the circle as well. Units: none.");
    prm.add_parameter("Pass bands", pass_bands,
                      "Periodic rails: the waves that pass from span to span, their phase and decay. Units: "
                      "none.");
    prm.add_parameter(
        "Impulse response time", impulse_time,
        "Bodies known by their Green's functions: impulse responses until then; 0: none. Units: s.",
        Double(0, 1e6));
    prm.add_parameter("Impulse response step", impulse_step, "Distance of their samples. Units: s.",
                      Double(1e-9, 1e3));
  }

  bool FrequencyResponseParameters::asks_for(const std::string &body) const
  {
    const std::vector<std::string> named = split_list(bodies);
    return named.empty() || std::count(named.begin(), named.end(), body) > 0;
  }

  void FrequencyResponseParameters::check() const
  {
    parsed_points();
    if (std::adjacent_find(list.begin(), list.end(), std::greater_equal<double>()) != list.end())
      throw InputError("Frequency response/Frequencies must ascend and hold no frequency twice.");
    if (n_refined > 0 && list.empty() && first == 0)
      throw InputError(
          "Frequency response/First frequency is 0, but Refined frequencies lie between others by their "
          "ratio: give a first frequency above 0.");
    if (list.empty() && first == 0 && spacing == "logarithmic")
      throw InputError(
          "Frequency response/First frequency is 0, but Spacing is logarithmic: set it to linear.");
    if (impulse_time > 1e6 * impulse_step)
      throw InputError(
          "Frequency response/Impulse response time asks for more than 1,000,000 samples: enlarge "
          "Impulse response step.");
    if (!(last > first))
      throw InputError("Frequency response/Last frequency (" + number_text(last) +
                       " Hz) must be above First frequency (" + number_text(first) + " Hz).");
    if (!cut_frequencies.empty() && check_frequencies.empty())
      throw InputError(
          "Frequency response/Cut frequencies says with which modes the comparison is repeated, but "
          "there is none: give Check frequencies.");
  }

  std::vector<ResponsePoint> FrequencyResponseParameters::parsed_points() const
  {
    std::vector<ResponsePoint> result;
    for (const std::string &entry : dealii::Utilities::split_string_list(points, ';'))
    {
      const auto colon = entry.find(':');
      const std::vector<std::string> parts =
          split_list(colon == std::string::npos ? "" : entry.substr(colon + 1));
      const auto fail = [&](const std::string &why)
      {
        throw InputError("Frequency response/Points: \"" + trimmed(entry) + "\" " + why +
                         "; write for instance midspan: 0, 0, z");
      };
      ResponsePoint point;
      point.name = trimmed(entry.substr(0, colon));
      if (point.name.empty() || (parts.size() != 3 && parts.size() != 4))
        fail("is not \"name: x, y, direction\" or \"name: x, y, z, direction\"");
      for (const char c : point.name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-')
          fail("has a name with other characters than letters, digits and -");
      const auto number = [&](const std::string &text)
      {
        try
        {
          const double value = dealii::Utilities::string_to_double(text);
          if (std::isfinite(value))
            return value;
        }
        catch (const dealii::ExceptionBase &)
        {
        }
        fail("has \"" + text + "\" where a number should be");
        return 0.;
      };
      point.x = number(parts[0]);
      point.y = number(parts[1]);
      if (parts.size() == 4)
        point.z = number(parts[2]);
      const auto direction = std::string("zxy").find(parts.back());
      if (parts.back().size() != 1 || direction == std::string::npos)
        fail("has the direction \"" + parts.back() + "\", which is not x, y or z");
      point.component = direction;
      for (const ResponsePoint &other : result)
        if (other.name == point.name && other.component == point.component)
          fail("comes twice");
      result.push_back(point);
    }
    if (result.empty())
      throw InputError("Frequency response/Points is empty; write for instance midspan: 0, 0, z");
    return result;
  }

  std::vector<double> FrequencyResponseParameters::frequencies() const
  {
    if (!list.empty())
      return list;
    std::vector<double> result;
    for (unsigned int k = 0; k < count; ++k)
    {
      const double t = double(k) / (count - 1);
      result.push_back(spacing == "linear" ? first + t * (last - first) : first * std::pow(last / first, t));
    }
    return result;
  }

  std::complex<double> FrequencyResponseParameters::shown(const std::complex<double> &receptance,
                                                          const double frequency) const
  {
    return is_mobility() ? receptance * std::complex<double>(0, 2 * dealii::numbers::PI * frequency)
                         : receptance;
  }
} // namespace vibrocontact
