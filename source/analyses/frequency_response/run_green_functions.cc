#include <vibrocontact/analyses/frequency_response/run_green_functions.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/receptances/pole_file.h>
#include <vibrocontact/run/identified_body.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using Complex = std::complex<double>;

    /// orders that a ring's direct inversion has in full at least, beside static ones: 1e-10 up to some kHz
    constexpr unsigned int direct_order = 400;

    struct GreenBody
    {
      /// points and pairs, no values
      FrequencyData names;
      BodyInContact poles;
    };

    GreenBody green_body(const Parameters &parameters, const std::optional<MeasuredData> &measured,
                         const BodyParameters &body)
    {
      GreenBody result;
      std::vector<std::string> &labels = result.names.labels;
      bool both_ways = false;
      if (body.description->measured())
      {
        IdentifiedPoles identified =
            identified_poles(parameters, measured, body, parameters.identification.contact_step);
        labels = identified.labels;
        both_ways = identified.both_ways;
        result.poles = identified.poles;
      }
      else
      {
        const PointBody &points = *body.description->at_points();
        const bool tangential = points.orders() && parameters.frequency_response.tangential;
        labels = points.row_names(tangential);
        both_ways = body.rolls();
        result.poles = by_poles(points.between_points(tangential, parameters.road.speed));
      }
      for (unsigned int i = 0; i < labels.size(); ++i)
        for (unsigned int j = both_ways ? 0 : i; j < labels.size(); ++j)
        {
          FrequencyData::Entry entry;
          entry.response = i;
          entry.reference = j;
          result.names.entries.push_back(entry);
        }
      return result;
    }

    FrequencyData evaluated(const GreenBody &body, const std::vector<double> &frequency,
                            const std::function<ComplexMatrix(double)> &matrix)
    {
      FrequencyData data = body.names;
      data.frequency = frequency;
      for (const double f : frequency)
      {
        const ComplexMatrix G = matrix(2 * M_PI * f);
        for (FrequencyData::Entry &entry : data.entries)
          entry.values.push_back(G(entry.response, entry.reference));
      }
      return data;
    }

    std::string pair_name(const FrequencyData &data, const FrequencyData::Entry &entry)
    {
      return data.labels[entry.response] + "_" + data.labels[entry.reference];
    }

    Table response_table(const FrequencyData &data, const FrequencyResponseParameters &asked,
                         const std::string &title)
    {
      std::vector<std::string> columns = {"frequency_Hz"};
      for (const FrequencyData::Entry &entry : data.entries)
        for (const char *part : {"_real", "_imag"})
          columns.push_back(pair_name(data, entry) + part + asked.unit_ending());
      Table table(
          columns,
          {title, asked.quantity +
                      " of the first point under a unit force e^{+j w t} at the second; z towards the "
                      "axle, x forward along the circle"});
      for (unsigned int l = 0; l < data.frequency.size(); ++l)
      {
        std::vector<Table::Cell> row = {data.frequency[l]};
        for (const FrequencyData::Entry &entry : data.entries)
        {
          const Complex value = asked.shown(entry.values[l], data.frequency[l]);
          row.push_back(value.real());
          row.push_back(value.imag());
        }
        table.add_row(row);
      }
      return table;
    }

    Table impulse_table(const GreenBody &body, const double end, const double step)
    {
      std::vector<std::string> columns = {"time_s"};
      for (const FrequencyData::Entry &entry : body.names.entries)
        columns.push_back(pair_name(body.names, entry) + "_m_Ns");
      Table table(columns,
                  {"Displacement of the first point after a unit impulse at the second, from the poles"});
      const unsigned int n = std::lround(end / step);
      for (unsigned int k = 0; k <= n; ++k)
      {
        const DenseMatrix g = impulse_response(body.poles, k * step);
        std::vector<Table::Cell> row = {k * step};
        for (const FrequencyData::Entry &entry : body.names.entries)
          row.push_back(g(entry.response, entry.reference));
        table.add_row(row);
      }
      return table;
    }

    PoleFit pole_fit(const GreenBody &body)
    {
      PoleFit fit;
      fit.poles = body.poles.poles;
      for (const FrequencyData::Entry &entry : body.names.entries)
      {
        fit.residues.emplace_back();
        for (unsigned int k = 0; k < body.poles.n_poles(); ++k)
          fit.residues.back().push_back(body.poles.right(entry.response, k) *
                                        body.poles.left(entry.reference, k));
        fit.direct.push_back(body.poles.residual(entry.response, entry.reference));
      }
      return fit;
    }

    /// Entries that vanish by symmetry have no error.
    Json error_json(const FrequencyData &exact, const FrequencyData &other)
    {
      std::vector<double> omega, sizes, errors;
      for (const double f : exact.frequency)
        omega.push_back(2 * M_PI * f);
      for (const FrequencyData::Entry &entry : exact.entries)
      {
        double size = 0;
        for (const Complex &value : entry.values)
          size = std::max(size, std::abs(value));
        sizes.push_back(size);
      }
      const double largest = *std::max_element(sizes.begin(), sizes.end());
      for (unsigned int i = 0; i < exact.entries.size(); ++i)
        errors.push_back(sizes[i] < 1e-10 * largest
                             ? 0.
                             : band_error(omega, exact.entries[i].values, other.entries[i].values));
      return {{"error_E_driving_point", errors.front()},
              {"error_E", *std::max_element(errors.begin(), errors.end())},
              {"error_E_entries", errors}};
    }

    /// What is lost by leaving out orders of a ring, and by its poles.
    /// @param sum over circumferential orders up to a highest one, with those above it static or without
    Json truncation_json(const std::function<FrequencyData(unsigned int, bool)> &sum,
                         const PointBody::Orders &kept, const std::vector<unsigned int> &orders,
                         const FrequencyData &direct, const FrequencyData &modal)
    {
      Json list = Json::array();
      const auto add =
          [&](const unsigned int order, const bool residual, const bool poles, const FrequencyData &other)
      {
        Json entry = {{"highest_order", order}, {"residual", residual}, {"poles", poles}};
        entry.update(error_json(direct, other));
        run_log().line(
            "|n| <= " + std::to_string(order) + (residual ? " and residual" : "") + (poles ? ", poles" : "") +
            ": E = " + number_text(entry["error_E_driving_point"].get<double>()) + " at the driving point, " +
            number_text(entry["error_E"].get<double>()) + " for the worst entry");
        list.push_back(entry);
      };
      for (const unsigned int order : orders)
        for (const bool residual : {false, true})
          add(order, residual, false, sum(order, residual));
      add(kept.highest, kept.residual, true, modal);
      return list;
    }
  } // namespace

  Json run_green_functions(const Parameters &parameters, const std::optional<MeasuredData> &measured,
                           const BodyParameters &own, const std::string &folder, Json &tables)
  {
    const FrequencyResponseParameters &asked = parameters.frequency_response;
    run_log().block("Green's functions of " + own.name);
    const GreenBody body = green_body(parameters, measured, own);
    run_log().value("poles", body.poles.n_poles());
    run_log().value("points and directions", (unsigned int)(body.names.labels.size()));
    const auto write = [&](const Table &table, const std::string &name)
    {
      const std::string file = name + "_" + own.name + ".csv";
      on_first_rank([&] { table.write(folder + "/" + file); });
      tables.push_back(file);
      return file;
    };
    const std::vector<double> frequency = asked.frequencies();
    const FrequencyData modal =
        evaluated(body, frequency, [&](const double omega) { return receptance(body.poles, omega); });
    const PointBody *const points = own.description->at_points();
    const std::optional<PointBody::Orders> orders = points ? points->orders() : std::nullopt;
    const auto sum = [&](const unsigned int highest, const bool residual)
    {
      const bool tangential = asked.tangential;
      return evaluated(body, frequency,
                       points->sum_of_orders(highest, residual, tangential, parameters.road.speed));
    };
    const bool is_direct = asked.method == "direct";
    if (is_direct && !orders)
      throw InputError("Frequency response/Method is direct, but " + own.name +
                       " is known by its poles alone: set "
                       "it to modal.");
    FrequencyData direct;
    if (orders)
      direct = sum(std::max(direct_order, orders->highest), true);
    const FrequencyData &shown = is_direct ? direct : modal;
    Json result = {
        {"kind", "Green's functions"}, {"method", asked.method}, {"n_poles", body.poles.n_poles()}};
    result["labels"] = body.names.labels;
    for (const FrequencyData::Entry &entry : body.names.entries)
      result["entries"].push_back(pair_name(body.names, entry));
    result["table"] =
        write(response_table(shown, asked, "Green's functions of " + own.name + ", method " + asked.method),
              "frequency_response");
    result["poles"] = write(poles_table(pole_fit(body), body.names, "Poles of " + own.name), "poles");
    if (asked.impulse_time > 0)
      result["impulse_response"] =
          write(impulse_table(body, asked.impulse_time, asked.impulse_step), "impulse_response");
    if (orders)
      result["truncation"] = truncation_json(sum, *orders, asked.truncated_orders, direct, modal);
    return result;
  }
} // namespace vibrocontact
