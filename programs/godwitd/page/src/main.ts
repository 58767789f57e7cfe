// The page of operators begins here.
import { listen_to_keys } from "./keys.ts";
import { page } from "./page.ts";
import { listen_to_drops } from "./uploader.ts";

const root = document.getElementById("page");
if (root !== null) {
  const all = new page(root);
  all.begin();
  listen_to_keys(all);
  listen_to_drops(all);
}
