// Values for all fields of a message: a few patterns that reach the ends of every type, and random ones.
// field_values.hpp has the same patterns and says what they mean.

// lower bytes, last but one, last; little-endian
export const byte_patterns = [
  [0x00, 0x00, 0x00],
  [0xff, 0xff, 0xff],
  [0x00, 0x00, 0x80],
  [0xff, 0xff, 0x7f],
  [0xff, 0x7f, 0x7f],
  [0x00, 0x80, 0x7f],
  [0x00, 0x80, 0xff],
];

const readers = {
  uint8_t: (view) => view.getUint8(0),
  uint8_t_mavlink_version: (view) => view.getUint8(0),
  int8_t: (view) => view.getInt8(0),
  uint16_t: (view) => view.getUint16(0, true),
  int16_t: (view) => view.getInt16(0, true),
  uint32_t: (view) => view.getUint32(0, true),
  int32_t: (view) => view.getInt32(0, true),
  uint64_t: (view) => view.getBigUint64(0, true),
  int64_t: (view) => view.getBigInt64(0, true),
  float: (view) => view.getFloat32(0, true),
};

// Random whole numbers below a limit, the same ones for the same seed (mulberry32).
export function random_numbers(seed) {
  let state = seed >>> 0;
  return (limit) => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) % limit;
  };
}

// NEXT_BYTES(size) gives the bytes of one number.
function value_of(field, next_bytes) {
  const type = field.type.replace("[]", "");
  if (!readers[type]) throw new Error(`${field.source} is a ${field.type}, and no message had such a field so far`);
  const one = () => readers[type](new DataView(Uint8Array.from(next_bytes(field.size)).buffer));
  return field.type.endsWith("[]") ? Array.from({ length: field.length }, one) : one();
}

const text_of_bytes = (bytes) => {
  const end = bytes.indexOf(0);
  return String.fromCharCode(...(end < 0 ? bytes : bytes.slice(0, end)));
};

function pattern_bytes([lower, last_but_one, last], size) {
  return Array.from({ length: size }, (_, i) => (i === size - 1 ? last : i === size - 2 ? last_but_one : lower));
}

function fill(message, give) {
  for (const field of message.constructor.FIELDS) message[field.name] = give(field);
  return message;
}

export function patterned(message_class, pattern) {
  return fill(new message_class(), (field) => field.type === "char[]"
    ? text_of_bytes(Array.from({ length: field.length }, () => pattern[2]))
    : value_of(field, (size) => pattern_bytes(pattern, size)));
}

// Any bits, texts of any length. One field in three is zero, so that ends of all lengths are cut off.
export function randomised(message_class, random) {
  const random_bytes = (size) => Array.from({ length: size }, () => random(256));
  return fill(new message_class(), (field) => {
    const zero = random(3) === 0;
    if (field.type !== "char[]") return value_of(field, zero ? (size) => Array(size).fill(0) : random_bytes);
    const length = zero ? 0 : random(field.length + 1);
    return String.fromCharCode(...Array.from({ length }, () => 1 + random(255)));
  });
}
