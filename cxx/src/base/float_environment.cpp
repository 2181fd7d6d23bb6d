#include "difmesh/float_environment.hpp"

namespace difmesh {

#if defined(__x86_64__) && defined(__GNUC__)

// <cfenv> would do, but loads and stores the whole x87 environment, 0.3 µs for each guard. This
// touches of the x87 what differs, which mostly is nothing.
namespace {

constexpr std::uint32_t kVectorDefault = 0x1F80;  // all traps masked, nearest, no flush to zero
constexpr std::uint32_t kVectorFlags = 0x3F;
constexpr std::uint16_t kX87Default = 0x037F;  // all traps masked, nearest, 64 bits
constexpr std::uint16_t kX87Flags = 0x3F;

struct X87Environment {
  std::uint16_t control, unused_0, status, unused_1, tag, unused_2;
  std::uint32_t rest[4];
};
static_assert(sizeof(X87Environment) == 28);

std::uint32_t vector_state() noexcept {
  std::uint32_t state = 0;
  __asm__ volatile("stmxcsr %0" : "=m"(state) : : "memory");
  return state;
}

void set_vector_state(std::uint32_t state) noexcept {
  __asm__ volatile("ldmxcsr %0" : : "m"(state) : "memory");
}

std::uint16_t x87_control() noexcept {
  std::uint16_t control = 0;
  __asm__ volatile("fnstcw %0" : "=m"(control));
  return control;
}

std::uint16_t x87_flags() noexcept {
  std::uint16_t status = 0;
  __asm__ volatile("fnstsw %0" : "=m"(status));
  return status & kX87Flags;
}

// Flags are changed while traps are masked, as `fnstenv` leaves them and the default has them.
void set_x87(std::uint16_t control, std::uint16_t flags) noexcept {
  if (x87_flags() != flags) {
    X87Environment environment;
    __asm__ volatile("fnstenv %0" : "=m"(environment));
    environment.status = static_cast<std::uint16_t>((environment.status & ~kX87Flags) | flags);
    environment.control = control;
    __asm__ volatile("fldenv %0" : : "m"(environment));
  } else if (x87_control() != control) {
    __asm__ volatile("fldcw %0" : : "m"(control));
  }
}

}  // namespace

FloatEnvironment FloatEnvironment::current() noexcept {
  FloatEnvironment result;
  result.vector_ = vector_state();
  result.x87_control_ = x87_control();
  result.x87_flags_ = x87_flags();
  return result;
}

void FloatEnvironment::set() const noexcept {
  set_x87(x87_control_, x87_flags_);
  set_vector_state(vector_);
}

void FloatEnvironment::set_without_flags() const noexcept {
  set_x87(x87_control_, 0);
  set_vector_state(vector_ & ~kVectorFlags);
}

void FloatEnvironment::set_default() noexcept {
  set_x87(kX87Default, 0);
  set_vector_state(kVectorDefault);
}

bool FloatEnvironment::is_default() noexcept {
  return (vector_state() & ~kVectorFlags) == kVectorDefault && x87_control() == kX87Default;
}

#else

FloatEnvironment FloatEnvironment::current() noexcept {
  FloatEnvironment result;
  std::fegetenv(&result.state_);
  return result;
}

void FloatEnvironment::set() const noexcept {
  std::fesetenv(&state_);
}

void FloatEnvironment::set_without_flags() const noexcept {
  std::fesetenv(&state_);
  std::feclearexcept(FE_ALL_EXCEPT);
}

void FloatEnvironment::set_default() noexcept {
  std::fesetenv(FE_DFL_ENV);
}

// Traps and the like cannot be asked for.
bool FloatEnvironment::is_default() noexcept {
  return false;
}

#endif

}  // namespace difmesh
