#include "programs/godwit-sim/vehicle/autopilot/param_list.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace godwit::sim {

namespace {

constexpr std::uint8_t int8 = 2;  // MAV_PARAM_TYPE
constexpr std::uint8_t int16 = 4; // MAV_PARAM_TYPE
constexpr std::uint8_t int32 = role::param_type_int32;
constexpr std::uint8_t real32 = role::param_type_real32;

} // namespace

std::vector<role::param> rover_params() {
  return {
      {"SYSID_THISMAV", 1, int32, false},   {"SYSID_MYGCS", 255, int32, true},   {"ARMING_CHECK", 1, int32, true},
      {"CRUISE_SPEED", 2, real32, true},    {"WP_SPEED", 2, real32, true},       {"WP_RADIUS", 2, real32, true},
      {"WP_ACCEL", 1, real32, true},        {"TURN_RATE", 45, real32, true},     {"RTL_SPEED", 2, real32, true},
      {"FS_GCS_ENABLE", 0, int32, true},    {"FS_TIMEOUT", 5, real32, true},     {"FENCE_ENABLE", 0, int32, true},
      {"BATT_CAPACITY", 5000, int32, true}, {"BATT_LOW_VOLT", 14, real32, true}, {"BATT_CRT_VOLT", 13.2F, real32, true},
      {"MIS_RESTART", 1, int32, true},      {"MIS_TOTAL", 0, int32, false},      {"STAT_RUNTIME", 0, int32, false},
  };
}

// Integers of PX4 are 32 bits wide; QGroundControl reads SYS_AUTOSTART, the RC_ and the COM_ ones to judge the setup.
// SYS_HITL is that of a vehicle in the field: with another one QGroundControl warns of a simulation.
std::vector<role::param> px4_params() {
  return {
      {"BAT1_CAPACITY", 5000, real32, true},
      {"BAT1_N_CELLS", 4, int32, true},
      {"BAT1_SOURCE", 0, int32, true},
      {"BAT1_V_CHARGED", 4.05F, real32, true},
      {"BAT1_V_EMPTY", 3.6F, real32, true},
      {"BAT_CRIT_THR", 0.07F, real32, true},
      {"BAT_EMERGEN_THR", 0.05F, real32, true},
      {"BAT_LOW_THR", 0.15F, real32, true},
      {"CAL_ACC0_ID", 1310988, int32, true},
      {"CAL_GYRO0_ID", 1310988, int32, true},
      {"CAL_MAG0_ID", 197388, int32, true},
      {"CA_ROTOR_COUNT", 4, int32, true},
      {"COM_ARM_WO_GPS", 1, int32, true},
      {"COM_DISARM_LAND", 2, real32, true},
      {"COM_DISARM_PRFLT", 10, real32, true},
      {"COM_DL_LOSS_T", 10, int32, true},
      {"COM_FLTMODE1", -1, int32, true},
      {"COM_FLTMODE2", -1, int32, true},
      {"COM_FLTMODE3", -1, int32, true},
      {"COM_FLTMODE4", -1, int32, true},
      {"COM_FLTMODE5", -1, int32, true},
      {"COM_FLTMODE6", -1, int32, true},
      {"COM_LOW_BAT_ACT", 0, int32, true},
      {"COM_OBL_RC_ACT", 0, int32, true},
      {"COM_RC_IN_MODE", 1, int32, true},
      {"EKF2_EN", 1, int32, true},
      {"GF_ACTION", 2, int32, true},
      {"GF_MAX_HOR_DIST", 0, real32, true},
      {"GF_MAX_VER_DIST", 0, real32, true},
      {"MAV_COMP_ID", 1, int32, false},
      {"MAV_SYS_ID", 1, int32, false},
      {"MAV_TYPE", 2, int32, false},
      {"MIS_DIST_1WP", 10000, real32, true},
      {"MIS_TAKEOFF_ALT", 2.5F, real32, true},
      {"MPC_LAND_SPEED", 0.7F, real32, true},
      {"MPC_TKO_SPEED", 1.5F, real32, true},
      {"MPC_XY_CRUISE", 5, real32, true},
      {"MPC_XY_VEL_MAX", 12, real32, true},
      {"MPC_Z_VEL_MAX_DN", 1.5F, real32, true},
      {"MPC_Z_VEL_MAX_UP", 3, real32, true},
      {"NAV_ACC_RAD", 10, real32, true},
      {"NAV_DLL_ACT", 0, int32, true},
      {"NAV_RCL_ACT", 2, int32, true},
      {"RC_CHAN_CNT", 0, int32, true},
      {"RC_MAP_MODE_SW", 0, int32, true},
      {"RC_MAP_PITCH", 0, int32, true},
      {"RC_MAP_ROLL", 0, int32, true},
      {"RC_MAP_THROTTLE", 0, int32, true},
      {"RC_MAP_YAW", 0, int32, true},
      {"RTL_DESCEND_ALT", 10, real32, true},
      {"RTL_LAND_DELAY", 0, real32, true},
      {"RTL_RETURN_ALT", 30, real32, true},
      {"RTL_TYPE", 0, int32, true},
      {"SYS_AUTOCONFIG", 0, int32, true},
      {"SYS_AUTOSTART", 10040, int32, true},
      {"SYS_HITL", 0, int32, true},
  };
}

namespace {

// Those that Copter and Plane share, with OWN: the ids first, the rest by name, as ArduPilot lists them. QGroundControl
// wants the RCMAP_, the COMPASS_ and the RC2 to RC4 ones (APMSensorsComponent, RadioComponent). With all 16 channels
// the file of the parameters is above a thousandth of the size that is told of it: below, QGroundControl sees no
// progress, reads it again and again, and reports that the vehicle does not respond.
std::vector<role::param> ardupilot_params(const std::vector<role::param>& own) {
  constexpr std::ptrdiff_t ids = 4;
  std::vector<role::param> result{
      {"SYSID_THISMAV", 1, int16, false},
      {"SYSID_MYGCS", 255, int16, true},
      {"MAV_SYSID", 1, int16, false},
      {"MAV_GCS_SYSID", 255, int16, true},
      {"ARMING_CHECK", 1, int32, true},
      {"BATT_CAPACITY", 5000, int32, true},
      {"BATT_FS_LOW_ACT", 0, int8, true},
      {"BATT_LOW_VOLT", 10.5F, real32, true},
      {"BATT_MONITOR", 4, int8, true},
      {"COMPASS_DEC", 0, real32, true},
      {"COMPASS_DEV_ID", 97539, int32, true},
      {"COMPASS_DEV_ID2", 131874, int32, true},
      {"COMPASS_DEV_ID3", 263178, int32, true},
      {"COMPASS_OFS2_X", 5, real32, true},
      {"COMPASS_OFS2_Y", 13, real32, true},
      {"COMPASS_OFS2_Z", -18, real32, true},
      {"COMPASS_OFS3_X", 5, real32, true},
      {"COMPASS_OFS3_Y", 13, real32, true},
      {"COMPASS_OFS3_Z", -18, real32, true},
      {"COMPASS_OFS_X", 5, real32, true},
      {"COMPASS_OFS_Y", 13, real32, true},
      {"COMPASS_OFS_Z", -18, real32, true},
      {"COMPASS_USE", 1, int8, true},
      {"COMPASS_USE2", 1, int8, true},
      {"COMPASS_USE3", 1, int8, true},
      {"FENCE_ENABLE", 0, int8, true},
      {"FENCE_TOTAL", 0, int8, false},
      {"FLTMODE6", 0, int8, true},
      {"MIS_OPTIONS", 0, int16, true},
      {"MIS_RESTART", 0, int8, true},
      {"MIS_TOTAL", 0, int16, false},
      {"RCMAP_PITCH", 2, int8, true},
      {"RCMAP_ROLL", 1, int8, true},
      {"RCMAP_THROTTLE", 3, int8, true},
      {"RCMAP_YAW", 4, int8, true},
      {"SIM_SPEEDUP", 1, real32, false},
      {"STAT_BOOTCNT", 1, int16, false},
      {"STAT_RUNTIME", 0, int32, false},
  };
  result.insert(result.end(), own.begin(), own.end());
  for (int channel = 2; channel <= 16; ++channel) {
    const auto name = "RC" + std::to_string(channel);
    result.push_back({name + "_DZ", 0, int16, true});
    result.push_back({name + "_MAX", 1900, int16, true});
    result.push_back({name + "_MIN", 1100, int16, true});
    result.push_back({name + "_OPTION", 0, int16, true});
    result.push_back({name + "_REVERSED", 0, int8, true});
    result.push_back({name + "_TRIM", 1500, int16, true});
  }
  std::ranges::sort(result.begin() + ids, result.end(), {}, &role::param::name);
  return result;
}

} // namespace

std::vector<role::param> copter_params() {
  return ardupilot_params({
      {"ANGLE_MAX", 3000, int16, true},
      {"AUTO_OPTIONS", 0, int32, true},
      {"BARO1_GND_PRESS", 95000, real32, true},
      {"BATT_CRT_VOLT", 0, real32, true},
      {"DISARM_DELAY", 10, int8, true},
      {"FENCE_ACTION", 1, int8, true},
      {"FENCE_ALT_MAX", 100, real32, true},
      {"FENCE_RADIUS", 300, real32, true},
      {"FENCE_TYPE", 7, int8, true},
      {"FLTMODE1", 7, int8, true},
      {"FLTMODE2", 9, int8, true},
      {"FLTMODE3", 6, int8, true},
      {"FLTMODE4", 3, int8, true},
      {"FLTMODE5", 5, int8, true},
      {"FLTMODE_CH", 5, int8, true},
      {"FRAME_CLASS", 1, int8, true},
      {"FRAME_TYPE", 0, int8, true},
      {"FS_GCS_ENABLE", 0, int8, true},
      {"FS_THR_ENABLE", 1, int8, true},
      {"GUID_OPTIONS", 0, int32, true},
      {"INS_ACCOFFS_X", 0.001F, real32, true},
      {"INS_ACCOFFS_Y", 0.001F, real32, true},
      {"INS_ACCOFFS_Z", 0.001F, real32, true},
      {"LAND_SPEED", 50, int16, true},
      {"PILOT_SPEED_UP", 250, int16, true},
      {"RC1_MAX", 2000, int16, true},
      {"RC1_MIN", 1000, int16, true},
      {"RC1_TRIM", 1500, int16, true},
      {"RTL_ALT", 1500, int32, true},
      {"RTL_ALT_FINAL", 0, int16, true},
      {"RTL_SPEED", 0, int16, true},
      {"SERVO1_FUNCTION", 33, int16, true},
      {"STAT_FLTTIME", 0, int32, false},
      {"WPNAV_ACCEL", 250, real32, true},
      {"WPNAV_RADIUS", 200, real32, true},
      {"WPNAV_SPEED", 1000, real32, true},
      {"WPNAV_SPEED_DN", 150, real32, true},
      {"WPNAV_SPEED_UP", 250, real32, true},
  });
}

std::vector<role::param> plane_params() {
  return ardupilot_params({
      {"AIRSPEED_CRUISE", 15, real32, true}, {"AIRSPEED_MAX", 22, int16, true},  {"AIRSPEED_MIN", 10, int16, true},
      {"FENCE_ACTION", 0, int8, true},       {"FLTMODE1", 10, int8, true},       {"FLTMODE2", 11, int8, true},
      {"FLTMODE3", 5, int8, true},           {"FLTMODE4", 5, int8, true},        {"FLTMODE5", 2, int8, true},
      {"FLTMODE_CH", 8, int8, true},         {"FS_LONG_ACTN", 0, int8, true},    {"FS_SHORT_ACTN", 0, int8, true},
      {"LAND_DISARMDELAY", 20, int8, true},  {"Q_ENABLE", 0, int8, false},       {"ROLL_LIMIT_DEG", 45, real32, true},
      {"RTL_ALTITUDE", 60, real32, true},    {"RTL_AUTOLAND", 3, int8, true},    {"RTL_RADIUS", 0, int16, true},
      {"TECS_CLMB_MAX", 4, real32, true},    {"TECS_SINK_MAX", 4, real32, true}, {"TKOFF_ALT", 50, real32, true},
      {"WP_LOITER_RAD", 60, int16, true},    {"WP_RADIUS", 30, int16, true},
  });
}

} // namespace godwit::sim
