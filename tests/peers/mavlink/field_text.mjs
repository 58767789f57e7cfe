// The text of a field in a description: the same for the same value, whoever writes it (field_text.hpp is the other and
// says how the texts look).

const hex = (value, digits) => value.toString(16).padStart(digits, "0");

function float_text(value) {
  if (Number.isNaN(value)) return "nan";
  const view = new DataView(new ArrayBuffer(4));
  view.setFloat32(0, value);
  return hex(view.getUint32(0), 8);
}

function text_of_one(type, value) {
  if (type === "float") return float_text(value);
  if (typeof value !== "bigint" && !Number.isInteger(value)) throw new Error(`${value} is no ${type}`);
  return value.toString();
}

// FIELD is node-mavlink's own description of it; a text comes from there as a string with one character a byte.
function text_of(field, value) {
  if (field.type === "char[]") return [...value].map((each) => hex(each.charCodeAt(0), 2)).join("");
  if (field.type.endsWith("[]")) return value.map((each) => text_of_one(field.type.slice(0, -2), each)).join(" ");
  return text_of_one(field.type, value);
}

// All fields of MESSAGE, under the names of the message definitions and not under those of JavaScript.
export function texts_of(message) {
  const fields = message.constructor.FIELDS;
  return Object.fromEntries(fields.map((field) => [field.source, text_of(field, message[field.name])]));
}
