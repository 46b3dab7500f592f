#include "reach/stiff_solver.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <new>
#include <utility>

namespace coordreq {
namespace {

constexpr int kSmallerStep = 1;  ///< what CVODE takes for a failure that a smaller step may mend

void ignore_message(int, const char*, const char*, char*, void*) {}

}  // namespace

/// The objects of CVODE, freed in the opposite order.
struct StiffSolver::Memory {
  Memory(Field rhs, std::span<const double> scale, double tolerance)
      : field(std::move(rhs)), x(static_cast<Eigen::Index>(scale.size())), derivative(x.size()) {
    const auto n = static_cast<sunindextype>(scale.size());
    bool made = SUNContext_Create(nullptr, &context) == 0;
    made = made && (state = N_VNew_Serial(n, context)) != nullptr;
    made = made && (absolute = N_VNew_Serial(n, context)) != nullptr;
    made = made && (matrix = SUNDenseMatrix(n, n, context)) != nullptr;
    made = made && (linear = SUNLinSol_Dense(state, matrix, context)) != nullptr;
    made = made && (cvode = CVodeCreate(CV_BDF, context)) != nullptr;
    if (!made) {
      free();
      throw std::bad_alloc();
    }
    for (std::size_t i = 0; i < scale.size(); ++i) NV_DATA_S(absolute)[i] = tolerance * scale[i];
    relative = tolerance;
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { free(); }

  void free() {
    if (cvode != nullptr) CVodeFree(&cvode);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    if (absolute != nullptr) N_VDestroy(absolute);
    if (state != nullptr) N_VDestroy(state);
    if (context != nullptr) SUNContext_Free(&context);
  }

  static int right_hand_side(realtype, N_Vector at, N_Vector result, void* user) {
    Memory& self = *static_cast<Memory*>(user);
    std::copy_n(NV_DATA_S(at), self.x.size(), self.x.data());
    self.field(self.x, self.derivative);
    if (!self.derivative.allFinite()) return kSmallerStep;
    std::copy_n(self.derivative.data(), self.derivative.size(), NV_DATA_S(result));
    return 0;
  }

  bool initialise() {
    initialised = CVodeInit(cvode, right_hand_side, 0.0, state) == CV_SUCCESS &&
                  CVodeSetErrHandlerFn(cvode, ignore_message, nullptr) == CV_SUCCESS &&
                  CVodeSetUserData(cvode, this) == CV_SUCCESS &&
                  CVodeSVtolerances(cvode, relative, absolute) == CV_SUCCESS &&
                  CVodeSetLinearSolver(cvode, linear, matrix) == CV_SUCCESS;
    return initialised;
  }

  Field field;
  Values x;
  Values derivative;
  double relative = 0.0;
  bool initialised = false;
  bool ready = false;
  realtype time = 0.0;    ///< since begin()
  realtype length = 0.0;  ///< of the last step
  SUNContext context = nullptr;
  N_Vector state = nullptr;
  N_Vector absolute = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  void* cvode = nullptr;
};

StiffSolver::StiffSolver(Field field, std::span<const double> scale, double tolerance)
    : memory_(std::make_unique<Memory>(std::move(field), scale, tolerance)) {}
StiffSolver::~StiffSolver() = default;
StiffSolver::StiffSolver(StiffSolver&&) noexcept = default;
StiffSolver& StiffSolver::operator=(StiffSolver&&) noexcept = default;

void StiffSolver::begin(const Values& x) {
  Memory& memory = *memory_;
  std::copy_n(x.data(), x.size(), NV_DATA_S(memory.state));
  memory.time = memory.length = 0.0;
  memory.ready =
      memory.initialised ? CVodeReInit(memory.cvode, 0.0, memory.state) == CV_SUCCESS : memory.initialise();
}

double StiffSolver::step(double most) {
  Memory& memory = *memory_;
  if (!memory.ready) return 0.0;
  const realtype before = memory.time;
  const realtype stop = before + most;
  if (CVodeSetStopTime(memory.cvode, stop) != CV_SUCCESS) return 0.0;
  const int flag = CVode(memory.cvode, stop, memory.state, &memory.time, CV_ONE_STEP);
  if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN) return 0.0;
  memory.length = memory.time - before;
  // Not what rounding makes of it: something would be left over that is too short for a step.
  return flag == CV_TSTOP_RETURN ? most : memory.length;
}

void StiffSolver::interpolate(double share, Values& x) const {
  const Memory& memory = *memory_;
  x.resize(memory.x.size());
  const realtype at = memory.time - (1.0 - share) * memory.length;
  if (share >= 1.0 || CVodeGetDky(memory.cvode, at, 0, memory.state) != CV_SUCCESS) {
    CVodeGetDky(memory.cvode, memory.time, 0, memory.state);
  }
  std::copy_n(NV_DATA_S(memory.state), x.size(), x.data());
}

}  // namespace coordreq
