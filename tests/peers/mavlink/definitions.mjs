// node-mavlink, and the classes of all messages by their ids: those of the newest mavlink-mappings, as the ones that
// node-mavlink brings along are older and lack PROTOCOL_VERSION.
//
// `lacking` is the one place for what its definitions do not have. Such a message is made from its published definition
// by the same generator that has made all others, so its layout and CRC_EXTRA are still not ours.
import { createRequire } from "node:module";

let library;
let mappings;
let generator;
try {
  const load = createRequire(import.meta.url);
  library = load("node-mavlink");
  mappings = load("mavlink-mappings");
  generator = { ...load("mavlink-mappings-gen/dist/generator/generators.js"),
    ...load("mavlink-mappings-gen/dist/generator/datasource.js") };
} catch (error) {
  console.error("mavlink_check: node-mavlink can not be loaded from tests/peers; run ./dev test, which installs it. " +
    `(${error.message})`);
  process.exit(1);
}
export const mavlink = library;

const lacking = [
  {
    id: 80,
    why: "marked as work in progress in MAVLink's common.xml, and the generator of node-mavlink leaves such out",
    definition: `<message id="80" name="COMMAND_CANCEL">
        <field type="uint8_t" name="target_system"/>
        <field type="uint8_t" name="target_component"/>
        <field type="uint16_t" name="command"/>
      </message>`,
  },
];

async function generate_class(definition) {
  const source = new generator.XmlDataSource();
  const { messageDefs: definitions } = await source.parse(`<mavlink><enums><enum name="NONE"><entry name="NONE"
    value="0"/></enum></enums><messages>${definition}</messages></mavlink>`);
  const { id, source: { name }, magic, payloadLength, fields } = [...definitions][0];
  const lines = [];
  generator.generateMessageDefinitionFields({ write: (line) => lines.push(line) }, fields);
  // The lines are `static FIELDS = [ new MavLinkPacketField(...), ... ]`.
  const with_fields = new Function("MavLinkPacketField", `return class { ${lines.join("\n")} };`);
  return Object.assign(with_fields(mappings.MavLinkPacketField),
    { MSG_ID: Number(id), MSG_NAME: name, MAGIC_NUMBER: magic, PAYLOAD_LENGTH: payloadLength });
}

export async function load_definitions() {
  const { minimal, standard, common, ardupilotmega } = mappings;
  const classes = { ...minimal.REGISTRY, ...standard.REGISTRY, ...common.REGISTRY, ...ardupilotmega.REGISTRY };
  const magic_numbers = { ...mappings.MSG_ID_MAGIC_NUMBER };
  for (const { id, why, definition } of lacking) {
    if (classes[id]) throw new Error(`node-mavlink has message ${id} now: take it off the list of what it lacks`);
    classes[id] = await generate_class(definition);
    magic_numbers[id] = classes[id].MAGIC_NUMBER;
    console.log(`${classes[id].MSG_NAME} is not in node-mavlink (${why}); made from its definition`);
  }
  return { classes, magic_numbers };
}
