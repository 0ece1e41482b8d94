#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/rail_supports.h>

#include <cmath>
#include <numeric>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  void RailSupports::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter("Contact at", contact_at, "Where the contact stands. Units: none.",
                      Patterns::Selection("mid-span|support"));
    prm.add_parameter("Sleeper spacing", sleeper_spacing, "Distance of the supports. Units: m.", Double(0));
    prm.add_parameter("Pad length", pad_length, "Length of a pad along the rail. Units: m.", Double(0));
    prm.add_parameter("Pad stiffness x", pad_stiffness_x, "Longitudinal stiffness of one pad. Units: N/m.",
                      Double(0));
    prm.add_parameter("Pad stiffness y", pad_stiffness_y, "Lateral stiffness of one pad. Units: N/m.",
                      Double(0));
    prm.add_parameter("Pad stiffness z", pad_stiffness_z,
                      "Vertical stiffness of one pad; all three zero: a free rail. Units: N/m.", Double(0));
    prm.add_parameter("Pad loss factor", pad_loss_factor, "Hysteretic loss factor of the pads. Units: none.",
                      Double(0, 10));
    prm.add_parameter(
        "Anechoic lengths", anechoic_lengths,
        "Lengths of the pieces of an anechoic end, from inside to outside (the paper: 0.6, 0.6, 0.6, 1.2, "
        "3.0); empty: plain free ends. Units: m.",
        Patterns::List(Double(0), 0, 50, ","));
    prm.add_parameter("Anechoic loss factor first", anechoic_loss_first,
                      "Loss factor of the innermost anechoic piece; geometric steps outwards. Units: none.",
                      Double(0, 10));
    prm.add_parameter("Anechoic loss factor last", anechoic_loss_last,
                      "Loss factor of the outermost anechoic piece. Units: none.", Double(0, 10));
  }

  void RailSupports::check(const std::string &path) const
  {
    const double anechoic = std::accumulate(anechoic_lengths.begin(), anechoic_lengths.end(), 0.);
    const bool some = has_pads(), all = pad_stiffness_x > 0 && pad_stiffness_y > 0 && pad_stiffness_z > 0;
    std::ostringstream text;
    if (!(length > 0.05) || length > 200)
      text << path << "/Length is " << length << " m: give a length between 0.05 and 200 m.";
    else if (some && !all)
      text << path
           << "/Pad stiffness x, y and z must be all positive, or all zero for a free rail: a rail that can "
           << "slide in one direction has no static response.";
    else if (some && !(sleeper_spacing >= 0.01))
      text << path << "/Sleeper spacing is " << sleeper_spacing << " m: give 0.01 m or more.";
    else if (some && !(pad_length >= 0 && pad_length <= sleeper_spacing))
      text << path << "/Pad length is " << pad_length << " m: it must not be above Sleeper spacing ("
           << sleeper_spacing << " m).";
    else if (some && supports().size() < 2)
      text << path << "/Length " << length << " m holds fewer than two supports at Sleeper spacing "
           << sleeper_spacing << " m; make the rail longer.";
    else if (2 * anechoic > length)
      text << path << "/Anechoic lengths add up to " << anechoic
           << " m at each end, more than the rail's half length " << length / 2 << " m.";
    else if (!anechoic_lengths.empty() &&
             (anechoic_loss_first <= 0 || anechoic_loss_last < anechoic_loss_first))
      text << path << "/Anechoic loss factor first (" << anechoic_loss_first
           << ") must be positive and not above the last (" << anechoic_loss_last << ").";
    if (!text.str().empty())
      throw InputError(text.str());
  }

  std::vector<double> RailSupports::supports() const
  {
    std::vector<double> result;
    if (!has_pads() || !(sleeper_spacing > 0))
      return result;
    const double first = is_over_support() ? 0 : 0.5;
    const int n = std::ceil(length / sleeper_spacing) + 1;
    for (int k = -n; k <= n; ++k)
      if (std::abs((k + first) * sleeper_spacing) + pad_length / 2 <= length / 2 * (1 + 1e-9))
        result.push_back((k + first) * sleeper_spacing);
    return result;
  }

  unsigned int RailSupports::anechoic_piece(const double x) const
  {
    double inner = length / 2 - std::accumulate(anechoic_lengths.begin(), anechoic_lengths.end(), 0.);
    unsigned int piece = 0;
    for (const double piece_length : anechoic_lengths)
    {
      if (std::abs(x) <= inner)
        break;
      ++piece;
      inner += piece_length;
    }
    return piece;
  }

  double RailSupports::anechoic_loss(const unsigned int piece) const
  {
    const unsigned int n = anechoic_lengths.size();
    return anechoic_loss_first *
           std::pow(anechoic_loss_last / anechoic_loss_first, n > 1 ? double(piece - 1) / (n - 1) : 0.);
  }

  void RailSupports::add_support_entries(EntriesRead &entries, const std::string &section, const BodyUse &use,
                                         const bool pieces_divide) const
  {
    entries.add(section, "Pad stiffness x, Pad stiffness y, Pad stiffness z");
    entries.add_if(has_pads(), "there are pads", section, "Contact at, Sleeper spacing, Pad length");
    entries.add_if(has_pads() && use.loss, "there are pads and the body moves", section, "Pad loss factor");
    entries.add_if(use.loss || pieces_divide, "the body moves", section, "Anechoic lengths");
    entries.add_if(use.loss && !anechoic_lengths.empty(), "the body moves and has Anechoic lengths", section,
                   "Anechoic loss factor first, Anechoic loss factor last");
  }

  std::pair<std::string, std::string> RailSupports::support_wanted(const std::string &path) const
  {
    if (has_pads())
      return {};
    return {path + " has no pad stiffness", "give Pad stiffness x, y and z"};
  }
} // namespace vibrocontact
