#include <vibrocontact/analyses/modal_convolution/method_comparison.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/processor_clock.h>
#include <vibrocontact/propagators/paper_methods.h>
#include <vibrocontact/propagators/step_weights.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  void ComparisonParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const std::string help =
        "Runs in which every method is timed and compared with the exact motion, as time step (s):number "
        "of steps:memory of the convolutions in steps, separated by commas; empty: no comparison. Units: "
        "none.";
    prm.add_parameter("Rows", rows, help, Anything());
    prm.add_parameter("Repetitions", repetitions, "Each timing is the median of so many runs. Units: none.",
                      Integer(1, 1000));
    for (auto &[name, body] : further_bodies)
    {
      prm.enter_subsection(name);
      prm.add_parameter("Rows", body.rows, help, Anything());
      prm.add_parameter("Force shape", body.force_shape,
                        "As Modal convolution/Force shape, for this body. Units: none.",
                        Selection("impulse|constant|linear"));
      prm.enter_subsection("Road");
      body.road.declare_parameters(prm);
      prm.leave_subsection();
      prm.leave_subsection();
    }
  }

  void ComparisonParameters::check() const
  {
    const std::string section = "Modal convolution/Comparison/";
    read_comparison_rows(rows, section + "Rows");
    for (const auto &[name, body] : further_bodies)
    {
      read_comparison_rows(body.rows, section + name + "/Rows");
      try
      {
        body.road.check();
      }
      catch (const InputError &error)
      {
        throw InputError(section + name + "/" + error.what());
      }
    }
  }

  bool ComparisonParameters::any() const
  {
    return !rows.empty() || std::any_of(further_bodies.begin(), further_bodies.end(),
                                        [](const auto &body) { return !body.second.rows.empty(); });
  }

  std::vector<ComparisonRow> read_comparison_rows(const std::string &rows, const std::string &entry)
  {
    std::vector<ComparisonRow> result;
    std::istringstream list(rows);
    for (std::string text; std::getline(list, text, ',');)
    {
      ComparisonRow row;
      char colon[2] = {0, 0};
      double n_steps = 0, memory = 0;
      std::istringstream numbers(text);
      numbers >> row.time_step >> colon[0] >> n_steps >> colon[1] >> memory;
      const bool is_read = !numbers.fail() && (numbers >> std::ws).eof();
      if (!is_read || colon[0] != ':' || colon[1] != ':' || !(row.time_step > 0) || !(n_steps >= 10) ||
          !(memory >= 2) || n_steps > 1e9 || memory > 1e8 || n_steps != std::floor(n_steps) ||
          memory != std::floor(memory))
        throw InputError(
            entry + " has '" + text +
            "', which is no time step:number of steps:memory: write for instance 1e-4:2000:1900.");
      row.n_steps = n_steps;
      row.memory = memory;
      result.push_back(row);
    }
    return result;
  }

  namespace
  {
    /// Displacement and force at the ends of the steps; n_points per step.
    struct History
    {
      std::vector<double> u, q, impulse;
      double seconds = 0;
    };

    double median(std::vector<double> values)
    {
      std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
      return values[values.size() / 2];
    }

    class Comparison
    {
    public:
      Comparison(const ComparisonRow &row, const unsigned int repetitions,
                 const ModalConvolutionParameters &parameters, const BodyInContact &model,
                 const RoadParameters &road, const std::vector<double> &places,
                 const std::vector<double> &shapes)
          : row(row), repetitions(repetitions), parameters(parameters), model(model),
            road(road, places, shapes, row.time_step * (row.n_steps + 1)), n(model.n_rows())
      {
        rigid = model.residual.m() == 0 || model.residual.linfty_norm() == 0;
        located = rigid && n <= 4;
      }

      std::vector<ComparedMethod> run()
      {
        const std::string shape = rigid ? "impulse" : parameters.force_shape;
        reference = located ? run_one("event located", shape, 1, 0)
                            : run_one("modal recursion", rigid ? "impulse" : "linear", 8, 0);
        find_quiet_lines();
        std::vector<ComparedMethod> result;
        const auto add = [&](const std::string &name, const unsigned long memory, const auto &work)
        {
          std::vector<double> seconds;
          History history;
          for (unsigned int k = 0; k < repetitions; ++k)
          {
            history = work();
            seconds.push_back(history.seconds / row.n_steps);
          }
          result.push_back(judge(name, memory, history, median(seconds)));
        };
        if (located)
          add("event located", 0, [&] { return run_one("event located", shape, 1, 0); });
        add("modal recursion", 0, [&] { return run_one("modal recursion", shape, 1, 0); });
        const unsigned long by_rule = steps_of_memory(model, row.time_step, 0.01, row.n_steps);
        for (const unsigned long memory : {row.memory, by_rule})
        {
          add("direct convolution", memory, [&] { return run_one("direct convolution", shape, 1, memory); });
          add("block convolution", memory, [&] { return run_one("block convolution", shape, 1, memory); });
        }
        add("direct convolution, scalar", row.memory,
            [&] { return run_one("direct convolution, scalar", shape, 1, row.memory); });
        if (n == 1 && rigid)
        {
          const auto paper = [&](const std::string &name, const PaperMethod::Form form)
          { add(name, 0, [&] { return run_paper(form); }); };
          paper("growing exponentials as printed", PaperMethod::Form::growing);
          paper("two Gauss forces, corrected", PaperMethod::Form::gauss);
          paper("two Gauss forces as printed", PaperMethod::Form::gauss_as_printed);
        }
        return result;
      }

    private:
      History run_one(const std::string &method, const std::string &shape, const unsigned int division,
                      const unsigned long memory)
      {
        ModalConvolutionParameters own = parameters;
        own.method = method;
        own.error_estimate = false;
        own.time_step = row.time_step / division;
        own.end_time = row.time_step * row.n_steps;
        own.memory = memory * own.time_step;
        own.force_shape = shape;
        own.contact_solver = "automatic";
        ModalConvolution run(own, {}, model, road);
        History history;
        history.u.resize(row.n_steps * n);
        history.q.resize(row.n_steps * n);
        // lines at the beginnings of steps belong to impulses: their forces are those at line k, not at its end
        const auto keep = [&](const ModalConvolutionLines &lines)
        {
          for (unsigned int k = 0; k < lines.n_lines; ++k)
          {
            const unsigned long line = lines.first_line + k;
            if (line == 0 || line % division != 0 || line / division > row.n_steps)
              continue;
            for (unsigned int i = 0; i < n; ++i)
            {
              history.u[(line / division - 1) * n + i] = lines.displacement[k * n + i];
              history.q[(line / division - 1) * n + i] = lines.force[k * n + i];
            }
          }
        };
        while (run.advance(4096, keep))
          ;
        history.impulse = run.result().impulse;
        history.seconds = run.result().seconds;
        return history;
      }

      History run_paper(const PaperMethod::Form form)
      {
        if (heights.empty())
          for (unsigned long k = 0; k < row.n_steps; ++k)
          {
            const auto at = road.at(0, (k + 1) * row.time_step);
            heights.push_back(at.value);
            rates.push_back(at.first);
          }
        PaperMethod method(form, model, parameters.first_state(model), row.time_step);
        History history;
        history.u.resize(row.n_steps);
        history.q.resize(row.n_steps);
        const double begin = processor_seconds();
        method.run(row.n_steps, heights.data(), rates.data(), history.u.data(), history.q.data());
        history.seconds = processor_seconds() - begin;
        history.impulse = {0.};
        for (const double force : history.q)
          history.impulse[0] += row.time_step * force;
        // an impulse's force belongs to the beginning of its step
        if (form == PaperMethod::Form::growing)
          history.q.erase(history.q.begin());
        return history;
      }

      /// Lines further than three steps from where the contact of any point changes.
      void find_quiet_lines()
      {
        quiet.assign(row.n_steps, 1);
        for (unsigned long k = 1; k < row.n_steps; ++k)
          for (unsigned int i = 0; i < n; ++i)
            if ((reference.q[k * n + i] > 0) != (reference.q[(k - 1) * n + i] > 0))
              for (unsigned long j = k < 4 ? 0 : k - 4; j < std::min(row.n_steps, k + 4); ++j)
                quiet[j] = 0;
        for (unsigned long j = 0; j < std::min(row.n_steps, 4ul); ++j)
          quiet[j] = 0;
      }

      ComparedMethod judge(const std::string &name, const unsigned long memory, const History &history,
                           const double seconds) const
      {
        ComparedMethod result = {name, row.time_step, row.n_steps, memory, 0, 0, 0, seconds};
        unsigned long count = 0;
        for (unsigned long k = 0; k + 1 < row.n_steps; ++k)
          for (unsigned int i = 0; i < n; ++i)
          {
            const double du = history.u[k * n + i] - reference.u[k * n + i],
                         dq = history.q[k * n + i] - reference.q[k * n + i];
            result.error_displacement =
                std::isfinite(du) ? std::max(result.error_displacement, std::abs(du)) : du;
            if (quiet[k])
            {
              result.error_force += dq * dq;
              ++count;
            }
          }
        result.error_force = std::sqrt(result.error_force / std::max(1ul, count));
        const double largest = *std::max_element(reference.impulse.begin(), reference.impulse.end());
        for (unsigned int i = 0; i < n; ++i)
        {
          const double error = std::abs(history.impulse[i] - reference.impulse[i]);
          result.error_impulse = std::isfinite(error) ? std::max(result.error_impulse, error) : error;
        }
        result.error_impulse /= largest > 0 ? largest : 1.;
        return result;
      }

      const ComparisonRow row;
      const unsigned int repetitions;
      const ModalConvolutionParameters &parameters;
      const BodyInContact &model;
      const Road road;
      const unsigned int n;
      /// the contact has no compliance; the exact motion is known from event to event
      bool rigid, located;
      History reference;
      std::vector<char> quiet;
      std::vector<double> heights, rates;
    };
  } // namespace

  std::vector<ComparedMethod> compare_methods(const std::vector<ComparisonRow> &rows,
                                              const unsigned int repetitions,
                                              const ModalConvolutionParameters &parameters,
                                              const BodyInContact &model, const RoadParameters &road,
                                              const std::vector<double> &places,
                                              const std::vector<double> &shapes)
  {
    std::vector<ComparedMethod> result;
    for (const ComparisonRow &row : rows)
    {
      const auto own = Comparison(row, repetitions, parameters, model, road, places, shapes).run();
      result.insert(result.end(), own.begin(), own.end());
    }
    return result;
  }
} // namespace vibrocontact
