#include "cli/report/difference_data.hpp"

#include <algorithm>
#include <cmath>

#include "cli/report/page.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/error.hpp"
#include "render/image/png.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

fs::path folder_of_pictures(const fs::path& given) {
  const fs::path folder = frames_of(given);
  if (picture_names(folder).empty())
    throw UsageError("there are no pictures (PNG) in '" + folder.string() +
                     "'; name a run folder or a folder of frames");
  return folder;
}

Json limits(const render::DifferenceLimit& limit, std::optional<double> warn) {
  return {{"tolerance", render::just_noticeable},
          {"share", limit.share},
          {"densest", limit.densest},
          {"greatest", std::isfinite(limit.greatest) ? Json(limit.greatest) : Json()},
          {"warn", warn}};
}

Json names(const std::vector<std::string>& all, const fs::path& folder, const Links& links) {
  Json list = Json::array();
  for (const std::string& name : all) list.add({{"name", name}, {"src", links.to_picture(folder / name)}});
  return list;
}

}  // namespace

Json difference_data(const Compared& compared, const fs::path& folder, const Links& links) {
  const fs::path expected = folder_of_pictures(compared.expected), got = folder_of_pictures(compared.got);
  FolderDifference all = compare_folders(expected, got, compared.limit);
  std::ranges::stable_sort(all.pictures, std::ranges::greater(), [&](const PictureDifference& picture) {
    return render::excess(picture.difference, compared.limit);
  });
  Json pictures = Json::array();
  for (const PictureDifference& picture : all.pictures) {
    const render::ImageDifference& d = picture.difference;
    Json shown{{"name", picture.name},
               {"alike", picture.alike},
               {"warns", warns(picture, compared.warn)},
               {"excess", render::excess(d, compared.limit)},
               {"share", d.share},
               {"densest", d.densest},
               {"greatest", d.greatest},
               {"expected", links.to_picture(expected / picture.name)},
               {"got", links.to_picture(got / picture.name)}};
    if (d.greatest > 0) {
      const fs::path file = folder / picture.name;
      if (!links.embeds()) begin_page(links.page());
      make_folder_of(file);
      render::write_png(render::difference_picture(render::read_png(expected / picture.name),
                                                   render::read_png(got / picture.name)),
                        file);
      shown["difference"] = links.to_picture(file);
    }
    pictures.add(std::move(shown));
  }
  return {{"expected", compared.expected.string()},
          {"got", compared.got.string()},
          {"alike", all.alike()},
          {"different", all.different()},
          {"limits", limits(compared.limit, compared.warn)},
          {"pictures", pictures},
          {"only_in_expected", names(all.only_in_a, expected, links)},
          {"only_in_got", names(all.only_in_b, got, links)}};
}

}  // namespace taut::cli
